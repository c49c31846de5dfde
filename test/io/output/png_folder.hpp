#pragma once

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "esi/io/output/png_folder_sink.hpp"
#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

// Small reconstructions as folders of PNG files.

namespace esi::test::png_folder {

inline constexpr int kWidth = 32, kHeight = 24;
inline constexpr const char* kManifest = "{\"fingerprint\": \"f1\"}\n";

inline SinkContext context(int threads = 1, const std::string& fingerprint = "f1") {
  return {{kWidth, kHeight}, 100, fingerprint, std::make_shared<WorkerPool>(threads - 1)};
}

inline Frame made_frame(std::int64_t index) { return frame_of(index, noise(index, kWidth, kHeight)); }

inline void write_frames(FrameSink& sink, std::int64_t end) {
  for (std::int64_t i = 0; i < end; ++i) sink.write(made_frame(i));
}

inline void write_run(const std::filesystem::path& folder, std::int64_t frames,
                      const SinkOptions& options = {}, int threads = 1) {
  PngFolderSink sink(folder, options, context(threads));
  write_frames(sink, frames);
  sink.finish(kManifest);
}

inline std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const std::string& name : names_in(folder)) contents[name] = content_of(folder / name);
  return contents;
}

inline ino_t file_number(const std::filesystem::path& path) {
  struct stat found {};
  REQUIRE(::stat(path.c_str(), &found) == 0);
  return found.st_ino;
}

inline constexpr SinkOptions kForce{true, false, 1}, kResume{false, true, 1};

}  // namespace esi::test::png_folder

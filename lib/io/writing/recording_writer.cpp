#include "esi/io/writing/recording_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/io/writing/aedat4_writer.hpp"
#include "esi/io/writing/dsec_writer.hpp"
#include "esi/io/writing/packet_check.hpp"
#include "esi/io/writing/rpg_text_writer.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

struct WritableFormat {
  std::string_view extension;
  bool holds_frames;
  std::unique_ptr<RecordingWriter> (*open)(const fs::path& path, const WriteOptions& options);
};

constexpr WritableFormat kFormats[] = {{".h5", false, open_dsec_writer},
                                       {".hdf5", false, open_dsec_writer},
                                       {".aedat4", true, open_aedat4_writer},
                                       {".txt", true, open_rpg_text_writer}};

const WritableFormat& format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const WritableFormat& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw usage_error(fmt::format("{}: a recording is written as .h5, .hdf5, .aedat4 or .txt, not as '{}'",
                                path.string(), path.extension().string()));
}

/// Lets a format's writer see only what it can rely on, and nothing after a failure.
class CheckedWriter final : public RecordingWriter {
 public:
  CheckedWriter(std::unique_ptr<RecordingWriter> writer, PacketCheck check, std::string name)
      : writer_(std::move(writer)), check_(std::move(check)), name_(std::move(name)) {}

  void write(const Packet& packet) override {
    require_open();
    is_open_ = false;
    check_.admit(packet);
    writer_->write(packet);
    is_open_ = true;
  }

  void finish() override {
    require_open();
    is_open_ = false;
    writer_->finish();
  }

 private:
  void require_open() const {
    if (!is_open_) throw Error(name_ + ": is finished or could not be written; write it anew");
  }

  std::unique_ptr<RecordingWriter> writer_;
  PacketCheck check_;
  std::string name_;
  bool is_open_ = true;
};

}  // namespace

bool holds_intensity_frames(const fs::path& path) { return format_of(path).holds_frames; }

std::unique_ptr<RecordingWriter> open_recording_writer(const fs::path& path, const WriteOptions& options) {
  const WritableFormat& format = format_of(path);
  PacketCheck check(options, path.string());
  return std::make_unique<CheckedWriter>(format.open(path, options), std::move(check), path.string());
}

}  // namespace esi

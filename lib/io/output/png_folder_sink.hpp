#pragma once

#include <deque>
#include <filesystem>
#include <future>
#include <memory>

#include "esi/io/output/frame_lists.hpp"
#include "esi/io/output/frame_sink.hpp"
#include "esi/io/output/output_folder.hpp"

namespace esi {

/// A folder as contract.md describes it: a PNG file per frame, the lists of frames, run.json last.
/// Frames are encoded by context.workers (and by this thread where it would wait); the lists hold only frames
/// that are whole.
class PngFolderSink final : public FrameSink {
 public:
  PngFolderSink(const std::filesystem::path& folder, const SinkOptions& options, const SinkContext& context);
  ~PngFolderSink() override;

  void write(const Frame& frame) override;
  void finish(const std::string& manifest) override;
  void stop() override;

 private:
  /// A frame (without its image) and its file, which may still be to come.
  struct Pending {
    Frame frame;
    std::future<void> written;
  };

  void require_no_failure() const;
  void settle_oldest();
  void keep_only_whole_frames();

  OutputFolder folder_;
  FrameLists lists_;
  SensorSize size_;
  int png_level_;
  std::int64_t frames_taken_ = 0;
  bool has_failed_ = false;
  std::deque<Pending> pending_;
  std::shared_ptr<WorkerPool> workers_;
};

}  // namespace esi

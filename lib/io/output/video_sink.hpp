#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string>

#include "esi/io/output/frame_sink.hpp"
#include "esi/io/output/lock_file.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {

/// A video: .mkv (FFV1, keeps every grey level), .mp4 (MPEG-4) or .avi (motion JPEG). Beside it
/// NAME.timestamps.txt and, last, NAME.run.json. OpenCV doesn't tell of failed writes, so the finished file
/// is read back before it gets its name.
class VideoSink final : public FrameSink {
 public:
  /// Makes the folders that lead to the file. Throws a usage Error for an unknown extension, an odd width or
  /// height (which the encoder would cut) and an existing file without options.force; options.resume is
  /// refused where there is something to resume.
  VideoSink(std::filesystem::path path, const SinkOptions& options, const SinkContext& context);

  void write(const Frame& frame) override;
  void finish(const std::string& manifest) override;
  void stop() override;

 private:
  void close_and_check();
  void put_in_place();

  std::filesystem::path path_;
  LockFile part_;
  OutputFile timestamps_;
  SensorSize size_;
  cv::VideoWriter writer_;
  std::int64_t frames_taken_ = 0;
};

}  // namespace esi

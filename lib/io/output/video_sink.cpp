#include "esi/io/output/video_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "esi/core/time.hpp"
#include "esi/io/output/output_folder.hpp"
#include "esi/io/output/video_container.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

struct VideoFormat {
  std::string_view extension;
  std::array<char, 5> codec;  ///< as OpenCV names it
};

constexpr VideoFormat kFormats[] = {{".mkv", {"FFV1"}}, {".mp4", {"mp4v"}}, {".avi", {"MJPG"}}};

const VideoFormat& format_of(const fs::path& path) {
  const std::string extension = media_extension(path);
  for (const VideoFormat& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw usage_error(
      fmt::format("{}: a video ends in .mkv, .mp4 or .avi, not in {}; end the path with / for a folder "
                  "of PNG files",
                  path.string(), path.extension().string()));
}

fs::path beside(fs::path path, const char* suffix) { return path += suffix; }
fs::path manifest_path(const fs::path& video) { return beside(video, ".run.json"); }
fs::path timestamps_path(const fs::path& video) { return beside(video, ".timestamps.txt"); }

/// Hidden, in the same folder, and with the extension from which the encoder takes the container. Absolute:
/// ffmpeg would take what stands before a colon for a protocol.
fs::path part_path(const fs::path& video) {
  const std::string name = "." + video.stem().string() + ".part" + video.extension().string();
  return fs::absolute(video).replace_filename(name);
}

void require_encodable(const fs::path& path, const SinkContext& context) {
  const SensorSize size = context.size;
  if (size.width_px <= 0 || size.height_px <= 0 || size.width_px % 2 != 0 || size.height_px % 2 != 0) {
    throw usage_error(
        fmt::format("{}: a video needs an even width and height, and this has {} px; write a folder",
                    path.string(), to_string(size)));
  }
  if (!(context.fps >= 0.01 && context.fps <= 1000)) {
    throw usage_error(fmt::format("{}: a video has 0.01 to 1000 frames per second, not {}; write a folder",
                                  path.string(), context.fps));
  }
}

void require_free(const fs::path& path, const SinkOptions& options, const std::string& fingerprint) {
  std::error_code error;
  if (is_there(path) && !fs::is_regular_file(path, error)) {
    throw usage_error(path.string() + ": is a device or a pipe, where a video is to be written");
  }
  if (options.force) return;
  if (options.resume && is_there(path)) {
    if (fingerprint_in(manifest_path(path)) == fingerprint) throw AlreadyComplete(path.string());
    throw usage_error(path.string() + ": a video cannot be resumed; --force replaces it");
  }
  for (const fs::path& file : {path, manifest_path(path), timestamps_path(path)}) {
    if (is_there(file)) throw usage_error(file.string() + ": is there already; --force replaces it");
  }
}

void make_folder_of(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::absolute(path).parent_path();
  fs::create_directories(folder, error);
  if (error) throw system_error(folder.string(), "cannot be created", error.value());
}

/// Looks before anything is written; makes the folder.
fs::path usable_path(fs::path path, const SinkOptions& options, const SinkContext& context) {
  format_of(path);
  require_encodable(path, context);
  require_free(path, options, context.fingerprint);
  make_folder_of(path);
  return path;
}

/// How many frames can be read from a file.
std::int64_t frames_in(const fs::path& video) {
  cv::VideoCapture capture(video.string(), cv::CAP_FFMPEG);
  std::int64_t frames = 0;
  while (capture.grab()) ++frames;
  return frames;
}

}  // namespace

VideoSink::VideoSink(fs::path path, const SinkOptions& options, const SinkContext& context)
    : path_(usable_path(std::move(path), options, context)),
      part_(part_path(path_), path_.string()),
      timestamps_(timestamps_path(path_)),
      size_(context.size) {
  part_.remove_at_end();
  const auto& codec = format_of(path_).codec;
  const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
  const cv::Size size(size_.width_px, size_.height_px);
  constexpr bool is_color = false;
  if (!writer_.open(part_.path().string(), cv::CAP_FFMPEG, fourcc, context.fps, size, is_color)) {
    throw Error(
        fmt::format("{}: the codec {} of OpenCV's ffmpeg cannot be opened for {} px at {} frames per second",
                    path_.string(), codec.data(), to_string(size_), context.fps));
  }
}

void VideoSink::write(const Frame& frame) {
  require_next_frame(frame, frames_taken_, size_);
  writer_.write(frame.grey);
  timestamps_.write(seconds_text(frame.t_us) + '\n');
  ++frames_taken_;
}

void VideoSink::finish(const std::string& manifest) {
  if (frames_taken_ == 0) throw Error(path_.string() + ": there are no frames, and a video needs one");
  close_and_check();
  put_in_place();
  if (!manifest.empty()) write_file(manifest_path(path_), manifest);
}

void VideoSink::stop() {
  if (frames_taken_ == 0) return;
  close_and_check();
  put_in_place();
}

void VideoSink::close_and_check() {
  writer_.release();
  if (is_whole_video(part_.path()) && frames_in(part_.path()) == frames_taken_) return;
  throw Error(path_.string() +
              ": could not be written whole (is the disk full, or the file larger than allowed?)");
}

void VideoSink::put_in_place() {
  remove_file(manifest_path(path_));
  std::error_code error;
  fs::rename(part_.path(), path_, error);
  if (error) throw system_error(path_.string(), "cannot be put in place", error.value());
  part_.keep_at_end();
  timestamps_.commit();
}

}  // namespace esi

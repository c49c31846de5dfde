#include "esi/io/output/frame_sink.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "esi/io/output/png_folder_sink.hpp"
#include "esi/io/output/video_sink.hpp"
#include "esi/io/output/y4m_sink.hpp"

namespace esi {
namespace {

/// What people may mean as a video or a picture. Any other name, with a dot in it or not, is a folder's.
constexpr std::string_view kMediaExtensions[] = {".mkv", ".mp4", ".avi", ".mov",  ".webm", ".mpg", ".mpeg",
                                                 ".gif", ".png", ".jpg", ".jpeg", ".y4m",  ".yuv"};

}  // namespace

bool means_folder(const std::filesystem::path& target) {
  std::error_code error;
  if (std::filesystem::is_directory(target, error)) return true;
  const std::string extension = media_extension(target);
  return std::find(std::begin(kMediaExtensions), std::end(kMediaExtensions), extension) ==
         std::end(kMediaExtensions);
}

void SinkOptions::declare(OptionTable& table) {
  table.toggle("force", force, "replace the reconstruction that is there");
  table.toggle("resume", resume, "continue an interrupted reconstruction of the same input and options");
  table.integer("png_compression", png_compression, {0, 9}, "",
                "0 stores, 1 is fast, 2 to 9 take about twice as long for files that may be smaller");
}

void require_next_frame(const Frame& frame, std::int64_t index, SensorSize size) {
  if (frame.index == index && frame.grey.cols == size.width_px && frame.grey.rows == size.height_px) return;
  throw Error(fmt::format("frame {} of {}x{} px came where frame {} of {} px was due", frame.index,
                          frame.grey.cols, frame.grey.rows, index, to_string(size)));
}

std::unique_ptr<FrameSink> open_frame_sink(const std::filesystem::path& target, const SinkOptions& options,
                                           const SinkContext& context) {
  if (target.empty()) throw usage_error("the output has no name");
  if (target == "-") {
    if (options.resume) throw usage_error("standard output: nothing there can be resumed");
    return std::make_unique<Y4mSink>(context, STDOUT_FILENO);
  }
  if (means_folder(target)) return std::make_unique<PngFolderSink>(target, options, context);
  return std::make_unique<VideoSink>(target, options, context);
}

}  // namespace esi

#include "esi/io/output/frame_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// What people may mean as a video or a picture. Any other name, with a dot in it or not, is a folder's.
constexpr std::string_view kMediaExtensions[] = {".mkv", ".mp4", ".avi", ".mov",  ".webm", ".mpg", ".mpeg",
                                                 ".gif", ".png", ".jpg", ".jpeg", ".y4m",  ".yuv"};

}  // namespace

std::string media_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

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

}  // namespace esi

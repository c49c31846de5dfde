#include <unistd.h>

#include "esi/core/error.hpp"
#include "esi/io/output/frame_sink.hpp"
#include "esi/io/output/png_folder_sink.hpp"
#include "esi/io/output/video_sink.hpp"
#include "esi/io/output/y4m_sink.hpp"

// Apart from what else belongs to sinks: a tool that opens none needn't load OpenCV's video libraries.
namespace esi {

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

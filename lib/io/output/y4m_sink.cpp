#include "esi/io/output/y4m_sink.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <numeric>

#include "esi/io/output/file_descriptor.hpp"

namespace esi {
namespace {

constexpr const char* kName = "standard output";

/// "100:1", exact to the micro-hertz.
std::string frame_rate(double fps) {
  if (!(fps >= 1e-6 && fps <= 1e6))
    throw usage_error(fmt::format("a video cannot have {} frames per second", fps));
  const auto rate_uhz = static_cast<std::int64_t>(std::llround(fps * 1e6));
  const std::int64_t divisor = std::gcd(rate_uhz, std::int64_t{1000000});
  return fmt::format("{}:{}", rate_uhz / divisor, 1000000 / divisor);
}

}  // namespace

Y4mSink::Y4mSink(const SinkContext& context, int file) : size_(context.size), file_(file) {
  if (::isatty(file) != 0) {
    throw usage_error(fmt::format("{}: is a terminal, which shows no frames; send it into a pipe", kName));
  }
  header_ = fmt::format("YUV4MPEG2 W{} H{} F{} Ip A1:1 Cmono\n", size_.width_px, size_.height_px,
                        frame_rate(context.fps));
}

void Y4mSink::write(const Frame& frame) {
  require_next_frame(frame, frames_taken_, size_);
  ++frames_taken_;
  buffer_ = std::exchange(header_, "") + "FRAME\n";
  for (int y = 0; y < frame.grey.rows; ++y) {
    buffer_.append(reinterpret_cast<const char*>(frame.grey[y]), static_cast<std::size_t>(frame.grey.cols));
  }
  send();
}

void Y4mSink::finish(const std::string& /*manifest*/) {
  buffer_ = std::exchange(header_, "");
  send();
}

void Y4mSink::send() {
  const int error = write_fully(file_, buffer_);
  if (error == EPIPE) throw ClosedPipe(kName);
  if (error != 0) throw system_error(kName, "cannot be written", error);
}

}  // namespace esi

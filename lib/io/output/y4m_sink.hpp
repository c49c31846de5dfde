#pragma once

#include <cstdint>
#include <string>

#include "esi/io/output/frame_sink.hpp"

namespace esi {

/// YUV4MPEG2 (grey, progressive) into a pipe. Throws ClosedPipe once the reader has gone, provided that the
/// program ignores SIGPIPE. Nothing is written before the first frame.
class Y4mSink final : public FrameSink {
 public:
  /// `file` is a descriptor that stays the caller's. Throws a usage Error for a terminal.
  Y4mSink(const SinkContext& context, int file);

  void write(const Frame& frame) override;
  void finish(const std::string& manifest) override;
  void stop() override {}

 private:
  void send();

  SensorSize size_;
  std::string header_;
  int file_;
  std::int64_t frames_taken_ = 0;
  std::string buffer_;
};

}  // namespace esi

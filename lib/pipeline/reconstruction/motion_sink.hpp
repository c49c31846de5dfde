#pragma once

#include <memory>
#include <utility>

#include "esi/io/output/frame_sink.hpp"
#include "esi/io/output/motion_folder.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// Frames to a sink of their own, and beside each the motion that its method made it with.
class MotionSink final : public FrameSink {
 public:
  /// `method` makes the frames, has a motion(), and outlives the sink.
  MotionSink(std::unique_ptr<FrameSink> frames, Reconstructor& method, const std::filesystem::path& folder,
             const SinkOptions& options, const std::string& fingerprint)
      : frames_(std::move(frames)), method_(method), folder_(folder, options, fingerprint) {}

  void write(const Frame& frame) override {
    frames_->write(frame);
    folder_.write(*method_.motion(), frame.index);
  }

  void finish(const std::string& manifest) override {
    folder_.complete(manifest);
    frames_->finish(manifest);
  }

  void stop() override { frames_->stop(); }

 private:
  std::unique_ptr<FrameSink> frames_;
  Reconstructor& method_;
  MotionFolder folder_;
};

}  // namespace esi

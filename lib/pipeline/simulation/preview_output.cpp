#include "esi/io/output/video_sink.hpp"
#include "esi/pipeline/simulation/regular_times.hpp"
#include "esi/pipeline/simulation/sim_output.hpp"

namespace esi {
namespace {

constexpr std::uint8_t kNoEvent = 128;
constexpr std::uint8_t kOff = 0;
constexpr std::uint8_t kOn = 255;

/// Two images side by side; a video needs an even height.
SensorSize video_size(SensorSize size) { return {2 * size.width_px, (size.height_px + 1) / 2 * 2}; }

/// Left the latest event of each pixel since the last frame, ON white, OFF black; right the latest intensity
/// frame.
class PreviewOutput final : public SimOutput {
 public:
  PreviewOutput(const std::filesystem::path& folder, SensorSize size, double fps)
      : times_(fps),
        video_(folder / "preview.mp4", SinkOptions{}, {video_size(size), fps, ""}),
        picture_(video_size(size).height_px, video_size(size).width_px, std::uint8_t{0}),
        events_(picture_(cv::Rect(0, 0, size.width_px, size.height_px))),
        intensity_(picture_(cv::Rect(size.width_px, 0, size.width_px, size.height_px))) {
    events_ = kNoEvent;
    next_us_ = times_.next(0);
  }

  void take(const Simulator& simulator, const Packet& packet) override {
    for (const Event& event : packet.events) {
      show_until(event.t_us, packet);
      events_(event.y, event.x) = event.on ? kOn : kOff;
    }
    show_until(simulator.t_us(), packet);
    if (!packet.frames.empty()) packet.frames.back().image.copyTo(intensity_);
  }

  void finish() override { video_.finish(""); }

 private:
  /// A frame at T shows the events with t < T.
  void show_until(std::int64_t t_us, const Packet& packet) {
    while (next_us_ && *next_us_ <= t_us) {
      for (const IntensityFrame& frame : packet.frames) {
        if (frame.exposure.end_us <= *next_us_) frame.image.copyTo(intensity_);
      }
      video_.write({index_++, *next_us_, 0, picture_});
      events_ = kNoEvent;
      next_us_ = times_.next(std::numeric_limits<std::int64_t>::max());
    }
  }

  RegularTimes times_;
  VideoSink video_;
  cv::Mat1b picture_, events_, intensity_;  ///< the latter two are parts of the first
  std::optional<std::int64_t> next_us_;
  std::int64_t index_ = 0;
};

}  // namespace

std::unique_ptr<SimOutput> open_preview_output(const std::filesystem::path& folder, SensorSize size,
                                               double fps) {
  return std::make_unique<PreviewOutput>(folder, size, fps);
}

}  // namespace esi

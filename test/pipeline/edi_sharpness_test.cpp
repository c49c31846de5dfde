// The double integral on a recording whose truth is known: fast motion, long exposures, no noise.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "esi/eval/image_quality.hpp"
#include "esi/recon/edi.hpp"
#include "esi/sim/simulator.hpp"

using namespace esi;

namespace {

constexpr std::int64_t kExposure_us = 60'000;

/// A pixel without noise, delay and variation, and the camera's frames without theirs.
SimOptions noise_free_slide() {
  SimOptions options;
  options.trajectory.kind = TrajectoryOptions::Kind::slide;
  options.trajectory.duration_s = 0.14;
  options.trajectory.height_m = 0.6;
  options.trajectory.slide_mps = 1.8;
  options.camera.sensor = "96x72";
  options.sensor.dark_current_lux = 0.0;
  options.sensor.lowpass = false;
  options.sensor.mismatch = 0.0;
  options.sensor.refractory_ms = 0.0;
  options.sensor.leak_hz = 0.0;
  options.sensor.shot_hz = 0.0;
  options.sensor.hot_share = 0.0;
  options.frames.exposure_ms = kExposure_us / 1000.0;
  options.frames.frame_period_ms = 70.0;
  options.frames.read_noise = 0.0;
  return options;
}

struct Clip {
  std::vector<Event> events;
  std::vector<IntensityFrame> frames;
};

Clip recorded(Simulator& simulator) {
  Clip clip;
  for (Packet packet; simulator.next(packet);) {
    clip.events.insert(clip.events.end(), packet.events.begin(), packet.events.end());
    std::move(packet.frames.begin(), packet.frames.end(), std::back_inserter(clip.frames));
  }
  return clip;
}

/// The way of the tags' corners in the image during an exposure, the shortest of all visible ones.
double blur_px(const Scenario& scenario, Interval exposure) {
  double shortest_px = HUGE_VAL;
  const auto before = scenario.tags(exposure.begin_us);
  const auto after = scenario.tags(exposure.end_us);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i].visible || !after[i].visible) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      shortest_px = std::min(shortest_px, cv::norm(after[i].corners[k] - before[i].corners[k]));
    }
  }
  return std::isinf(shortest_px) ? 0.0 : shortest_px;
}

/// Shows a method all that happened before t_us.
template <class Method>
void play(const Clip& clip, std::int64_t t_us, Method& method) {
  std::span<const Event> left = clip.events;
  const auto feed = [&](std::int64_t until_us) {
    const auto end = std::partition_point(left.begin(), left.end(),
                                          [&](const Event& event) { return event.t_us < until_us; });
    const auto count = static_cast<std::size_t>(end - left.begin());
    method.process(left.first(count));
    left = left.subspan(count);
  };
  for (const IntensityFrame& frame : clip.frames) {
    if (frame.exposure.end_us > t_us) break;
    feed(frame.exposure.end_us);
    method.observe(frame);
  }
  feed(t_us);
}

double psnr_db(const cv::Mat& image, const cv::Mat1b& clean) {
  return fitted_error(image, clean).psnr_db.value();
}

/// By how much EDI's image at an exposure's reference time is closer to the truth than the blurred frame.
double gain_db(const Simulator& simulator, const Clip& clip, const IntensityFrame& frame,
               const EdiOptions& options, std::int64_t reference_us) {
  Edi edi(options, simulator.sensor_size());
  play(clip, frame.exposure.end_us, edi);
  cv::Mat1b sharp;
  edi.render(frame.exposure.end_us, sharp);
  const cv::Mat1b clean = simulator.scenario().clean_frame(reference_us);
  return psnr_db(sharp, clean) - psnr_db(frame.image, clean);
}

}  // namespace

// 6 dB are promised. Here it is 13: all that is left is what an event, a step of 0.25 in log intensity, can't
// tell.
TEST_CASE("EDI makes a blurred frame sharp by more than 6 dB where its contrast threshold is the true one") {
  const SimOptions options = noise_free_slide();
  const double c = options.sensor.threshold;
  Simulator simulator(options, 1);
  const Clip clip = recorded(simulator);
  REQUIRE(clip.frames.size() == 2);
  for (const IntensityFrame& frame : clip.frames) {
    const auto [begin_us, end_us] = frame.exposure;
    REQUIRE(end_us - begin_us == kExposure_us);
    REQUIRE(blur_px(simulator.scenario(), frame.exposure) >= 8.0);
    const auto gain = [&](double contrast, ReferenceTime reference, std::int64_t reference_us) {
      return gain_db(simulator, clip, frame, {contrast, reference}, reference_us);
    };
    const std::int64_t middle_us = (begin_us + end_us) / 2;
    const double in_the_middle = gain(c, ReferenceTime::middle, middle_us);
    CHECK(in_the_middle >= 12.0);
    CHECK(gain(c, ReferenceTime::start, begin_us) >= 12.0);
    CHECK(gain(c, ReferenceTime::end, end_us) >= 12.0);
    CHECK(in_the_middle > gain(0.7 * c, ReferenceTime::middle, middle_us) + 1.0);
    CHECK(in_the_middle > gain(1.4 * c, ReferenceTime::middle, middle_us) + 1.0);
  }
}

TEST_CASE("between frames edi-propagated is closer to the truth than the blurred frame and the sharp one") {
  const SimOptions options = noise_free_slide();
  Simulator simulator(options, 1);
  const Clip clip = recorded(simulator);
  const IntensityFrame& frame = clip.frames.front();
  const std::int64_t t_us = frame.exposure.end_us + 9'000;
  REQUIRE(t_us < clip.frames.back().exposure.begin_us);
  const EdiOptions edi_options{.contrast = options.sensor.threshold};
  EdiPropagated propagated(edi_options, simulator.sensor_size());
  Edi resting(edi_options, simulator.sensor_size());
  play(clip, t_us, propagated);
  play(clip, t_us, resting);
  cv::Mat1b moved_on, sharp;
  propagated.render(t_us, moved_on);
  resting.render(t_us, sharp);
  const cv::Mat1b clean = simulator.scenario().clean_frame(t_us);
  CHECK(psnr_db(moved_on, clean) >= psnr_db(frame.image, clean) + 12.0);
  CHECK(psnr_db(moved_on, clean) >= psnr_db(sharp, clean) + 6.0);
}

// What the parts of esi-flow cost, at two sensor sizes, beside the least memory traffic that each needs.
//   build/release/bin/bench_flow

#include <fmt/format.h>

#include <array>
#include <functional>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "esi/recon/flow/brightness_model.hpp"
#include "esi/recon/flow/esi_flow.hpp"
#include "timing.hpp"

namespace {

constexpr int kRounds = 25;

/// The floor is copying: what is read and written once.
double copy_gb_s(cv::Size size) {
  const cv::Mat1f from(size, 1.0F);
  cv::Mat1f to(size, 0.0F);
  std::vector<double> times;
  for (int i = 0; i < kRounds; ++i) {
    times.push_back(esi::bench::seconds([&] {
      for (int k = 0; k < 10; ++k) from.copyTo(to);
    }));
  }
  return 10.0 * 8e-9 * static_cast<double>(size.area()) / esi::bench::median(times);
}

cv::Mat1f random_image(cv::Size size, std::mt19937& random) {
  cv::Mat1f image(size);
  for (float& value : image) value = static_cast<float>(static_cast<double>(random()) / 4294967296.0 - 0.5);
  return image;
}

/// A window's events, a fifteenth of the pixels.
std::vector<esi::Event> window_of(esi::SensorSize size, std::int64_t begin_us, std::mt19937& random) {
  const auto count = static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px) / 15;
  std::vector<esi::Event> events;
  for (std::size_t i = 0; i < count; ++i) {
    events.push_back({begin_us + static_cast<std::int64_t>(9999 * i / count),
                      static_cast<std::uint16_t>(random() % static_cast<unsigned>(size.width_px)),
                      static_cast<std::uint16_t>(random() % static_cast<unsigned>(size.height_px)),
                      random() % 2 == 0});
  }
  return events;
}

struct Part {
  std::string name;
  double planes;  ///< read or written at least, of 4 bytes a pixel
  std::function<void()> work;
};

void measure(const std::vector<Part>& parts, cv::Size size, double gb_s) {
  std::vector<std::vector<double>> times(parts.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      times[i].push_back(esi::bench::seconds(parts[i].work));
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double ms = 1e3 * esi::bench::median(times[i]);
    const double least_ms = 1e3 * parts[i].planes * 4e-9 * static_cast<double>(size.area()) / gb_s;
    fmt::print("  {:28} {:8.3f} ms   {:5.1f} planes: {:7.3f} ms at least\n", parts[i].name, ms,
               parts[i].planes, least_ms);
  }
}

void compare(esi::SensorSize sensor) {
  const cv::Size size(sensor.width_px, sensor.height_px);
  const double gb_s = copy_gb_s(size);
  fmt::print("{}x{}, copying at {:.1f} GB/s\n", size.width, size.height, gb_s);
  std::mt19937 random(1);
  const esi::EsiFlowOptions options;
  esi::EventImage event_image(sensor, true);
  esi::SmoothHalf smooth(options.flow_blur_px);
  esi::MotionEstimator motion(size, {16.0, 0.1, 2});
  esi::CellGrid cells(size, 16.0);
  esi::BrightnessModel model(size, options.model());
  esi::MultilevelSolver solver(size, options.solver());
  const auto events = window_of(sensor, 0, random);
  const cv::Mat1f b = random_image(size, random);
  cv::Mat1f half_a, half_b, rhs;
  smooth(b, half_a);
  smooth(random_image(size, random), half_b);
  // Cells differ by a third of a pixel on average: more than most scenes do.
  esi::MotionField field{random_image(cells.size(), random), random_image(cells.size(), random)};
  for (float& v : field.x) v += 0.7F;
  for (float& v : field.y) v -= 0.4F;
  const std::array pairs{esi::MovedPair{half_a, half_b, 1.0F, 1.0F},
                         esi::MovedPair{half_b, half_a, 1.0F, 1.0F}};
  const std::vector<Part> parts{
      {"event image", 1.0, [&] { event_image.of(events, {}); }},
      {"half size and Gaussian", 1.25, [&] { smooth(b, half_a); }},
      {"flow", 4 * 2 * 0.25,
       [&] {
         esi::MotionField warm{field.x.clone(), field.y.clone()};
         motion.improve(pairs, warm);
       }},
      {"warp and accumulate", 13.0, [&] { model.take(b, field, cells); }},
      {"right-hand side", 3.0, [&] { model.right_hand_side(rhs); }},
      // The residual, the coarse A, the correction from below, then a basis that is written and summed.
      {"solver", 6.0 + 3.0 + 6.0 + 6.0 + 3.0 + 2.0 * static_cast<double>(options.steps_full),
       [&] { solver.solve(model.normal_operator(), rhs, 1, model.log_intensity()); }},
  };
  measure(parts, size, gb_s);
  esi::EsiFlow whole(options, sensor);
  std::int64_t begin_us = 0;
  cv::Mat1b grey;
  const auto frame = [&] {
    const auto window = window_of(sensor, begin_us, random);
    begin_us += options.window_us;
    return esi::bench::seconds([&] {
      whole.process(window);
      whole.render(begin_us, grey);
    });
  };
  std::vector<double> times;
  for (std::int64_t i = 0; i < options.first_windows; ++i) frame();
  for (int i = 0; i < kRounds; ++i) times.push_back(frame());
  fmt::print("  {:28} {:8.3f} ms\n", "a whole frame", 1e3 * esi::bench::median(times));
}

}  // namespace

int main() {
  compare({346, 260});
  compare({1280, 720});
}

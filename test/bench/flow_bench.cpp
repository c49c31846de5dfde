// What the parts of esi-flow cost, at two sensor sizes, beside the least memory traffic that each needs: the
// thread's processor time. Then what passes on the clock with one thread and with two, run in turn: the
// least, which other work on the machine disturbs less than the median.
//   build/release/bin/bench_flow

#include <fmt/format.h>

#include <array>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "esi/recon/flow/brightness_model.hpp"
#include "esi/recon/flow/esi_flow.hpp"
#include "esi/recon/flow/motion_sign.hpp"
#include "recon/flow/flow_configs.hpp"
#include "timing.hpp"

namespace {

constexpr int kRounds = 25;

/// The floor is copying: what is read and written once.
double copy_gb_s(cv::Size size) {
  const cv::Mat1f from(size, 1.0F);
  cv::Mat1f to(size, 0.0F);
  std::vector<double> times;
  times.reserve(kRounds);
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
  std::function<void(const esi::RowTeam& team)> work;
};

std::shared_ptr<esi::WorkerPool> one_worker() { return std::make_shared<esi::WorkerPool>(1); }

void print_clock(const std::string& name, const std::vector<double>& one, const std::vector<double>& two) {
  const double one_ms = 1e3 * esi::bench::least(one);
  const double two_ms = 1e3 * esi::bench::least(two);
  fmt::print("  {:28} {:8.3f} ms   {:8.3f} ms   {:5.2f}\n", name, one_ms, two_ms, one_ms / two_ms);
}

void measure(const std::vector<Part>& parts, cv::Size size, double gb_s) {
  std::vector<std::vector<double>> times(parts.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      times[i].push_back(esi::bench::seconds([&] { parts[i].work(esi::kAlone); }));
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double ms = 1e3 * esi::bench::median(times[i]);
    const double least_ms = 1e3 * parts[i].planes * 4e-9 * static_cast<double>(size.area()) / gb_s;
    fmt::print("  {:28} {:8.3f} ms   {:5.1f} planes: {:7.3f} ms at least\n", parts[i].name, ms,
               parts[i].planes, least_ms);
  }
}

void measure_by_clock(const std::vector<Part>& parts) {
  esi::RowTeam team;
  team.use(one_worker());
  std::vector<std::vector<double>> one(parts.size()), two(parts.size());
  for (int round = 0; round < 2 * kRounds; ++round) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].work(esi::kAlone);
      one[i].push_back(esi::bench::wall_seconds([&] { parts[i].work(esi::kAlone); }));
      const auto shift = team.begin_shift();
      parts[i].work(team);  // in the meantime the worker comes
      two[i].push_back(esi::bench::wall_seconds([&] { parts[i].work(team); }));
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) print_clock(parts[i].name, one[i], two[i]);
}

/// The whole method, frame after frame.
class Frames {
 public:
  Frames(const esi::EsiFlowOptions& options, esi::SensorSize sensor, std::shared_ptr<esi::WorkerPool> workers)
      : sensor_(sensor), flow_(options, sensor) {
    flow_.use_workers(std::move(workers));
    for (std::int64_t i = 0; i < options.first_windows; ++i) next();
  }

  /// Processor time of this thread, and time on the clock.
  std::pair<double, double> next() {
    const auto window = window_of(sensor_, begin_us_, random_);
    begin_us_ += esi::EsiFlowOptions().window_us;
    double cpu_s = 0.0;
    const auto frame = [&] {
      flow_.process(window);
      flow_.render(begin_us_, grey_);
    };
    const double clock_s = esi::bench::wall_seconds([&] { cpu_s = esi::bench::seconds(frame); });
    return {cpu_s, clock_s};
  }

 private:
  esi::SensorSize sensor_;
  esi::EsiFlow flow_;
  std::mt19937 random_{1};
  std::int64_t begin_us_ = 0;
  cv::Mat1b grey_;
};

/// In turn, ten frames with one thread and ten with two, so that each finds its own data in cache.
void measure_frames(const std::string& config, esi::SensorSize sensor) {
  const esi::EsiFlowOptions options = esi::test::flow_options_of(config);
  Frames one(options, sensor, nullptr);
  Frames two(options, sensor, one_worker());
  std::vector<double> cpu, clock, clock_two;
  for (int i = 0; i < 2 * kRounds; i += 10) {
    for (int k = 0; k < 10; ++k) {
      const auto [cpu_s, clock_s] = one.next();
      cpu.push_back(cpu_s);
      clock.push_back(clock_s);
    }
    for (int k = 0; k < 10; ++k) clock_two.push_back(two.next().second);
  }
  print_clock("a frame of " + config, clock, clock_two);
  fmt::print("  {:28} {:8.3f} ms   {:8.3f} ms   {:8.3f} ms of processor time with 1 thread\n", "its median",
             1e3 * esi::bench::median(clock), 1e3 * esi::bench::median(clock_two),
             1e3 * esi::bench::median(cpu));
}

void compare(esi::SensorSize sensor) {
  const cv::Size size(sensor.width_px, sensor.height_px);
  const double gb_s = copy_gb_s(size);
  fmt::print("{}x{}, copying at {:.1f} GB/s\n", size.width, size.height, gb_s);
  std::mt19937 random(1);
  const esi::EsiFlowOptions options;
  esi::EventImage event_image(sensor, true);
  esi::SmoothHalf smooth(options.flow_blur_px);
  esi::MotionEstimator motion(
      size, {16.0, options.flow_regularisation, options.flow_hold, static_cast<int>(options.flow_rounds)});
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
  esi::MotionSign sign(half_a.size(), motion.cells());
  const std::vector<Part> parts{
      {"event image", 1.0, [&](const esi::RowTeam&) { event_image.of(events, {}); }},
      {"half size and Gaussian", 1.25, [&](const esi::RowTeam& team) { smooth(b, half_a, team); }},
      {"flow", 4 * 2 * 0.25,
       [&](const esi::RowTeam& team) {
         esi::MotionField warm{field.x.clone(), field.y.clone()};
         motion.improve(pairs, warm, team);
       }},
      {"speed", 2 * 0.25,
       [&](const esi::RowTeam& team) {
         esi::MotionField warm{field.x.clone(), field.y.clone()};
         motion.correct_speed(pairs[1], warm, team);
       }},
      {"sign", 9 * 0.25, [&](const esi::RowTeam& team) { sign.take(half_a, field, team); }},
      {"warp and accumulate", 13.0,
       [&](const esi::RowTeam& team) { model.take(b, 1.0, field, cells, team); }},
      {"right-hand side", 3.0, [&](const esi::RowTeam& team) { model.right_hand_side(rhs, team); }},
      // The residual, the coarse A, the correction from below, then a basis that is written and summed.
      {"solver", 6.0 + 3.0 + 6.0 + 6.0 + 3.0 + 2.0 * static_cast<double>(options.steps_full),
       [&](const esi::RowTeam& team) {
         solver.solve(model.normal_operator(), rhs, 1, model.log_intensity(), team);
       }},
  };
  measure(parts, size, gb_s);
  fmt::print("  on the clock, at least           1 thread     2 threads   ratio\n");
  measure_by_clock(parts);
  for (const char* config : {"esi-flow", "esi-flow-fast"}) measure_frames(config, sensor);
}

}  // namespace

int main() {
  compare({346, 260});
  compare({1280, 720});
}

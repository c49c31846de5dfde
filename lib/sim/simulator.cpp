#include "esi/sim/simulator.hpp"

#include <algorithm>
#include <future>
#include <numeric>

#include "esi/sim/renderer.hpp"

namespace esi {
namespace {

/// 16 rows of a DAVIS346 are 180 kB of pixels.
constexpr int kBlockRows = 16;
/// Blocks go on by themselves for this long.
constexpr std::int64_t kBatch_us = 5000;
/// A packet spans no more than this, however little happens.
constexpr std::int64_t kPacketSpan_us = 100'000;

std::int64_t end_of(const SimOptions& options, const Scenario& scenario) {
  const std::int64_t duration_us = scenario.duration_us();
  return options.end_s ? std::min(us_from_seconds(*options.end_s), duration_us) : duration_us;
}

}  // namespace

Simulator::Simulator(const SimOptions& options, int threads)
    : scenario_(options.scene, options.trajectory, options.camera, options.scene_seed),
      end_us_(end_of(options, scenario_)),
      pixels_(options.sensor, scenario_.camera(), options.seed),
      exposure_(options.frames, scenario_.camera().size, end_us_, options.seed),
      planner_(options.steps, scenario_),
      pool_(std::max(threads, 1) - 1),
      light_(scenario_.camera().size.height_px, scenario_.camera().size.width_px) {
  for (int row = 0; row < light_.rows; row += kBlockRows) {
    blocks_.push_back({row, std::min(row + kBlockRows, light_.rows), {}});
  }
  settle();
}

std::span<float> Simulator::light_of(int y) { return {light_[y], static_cast<std::size_t>(light_.cols)}; }

std::vector<Phase> Simulator::phases() const {
  std::vector<Phase> phases = scenario_.phases();
  std::erase_if(phases, [this](const Phase& phase) { return phase.interval.begin_us >= end_us_; });
  for (Phase& phase : phases) phase.interval.end_us = std::min(phase.interval.end_us, end_us_);
  return phases;
}

void Simulator::settle() {
  for (int y = 0; y < light_.rows; ++y) {
    render_row(planner_.view(), y, light_of(y));
    pixels_.start(y, light_of(y));
  }
}

bool Simulator::next(Packet& packet) {
  packet.clear();
  causes_.clear();
  const std::int64_t begin_us = t_us_;
  const std::int64_t span_end_us = std::min(begin_us + kPacketSpan_us, end_us_);
  while (t_us_ < span_end_us && packet.events.size() < kPacketEvents) {
    const std::int64_t batch_begin_us = t_us_;
    simulate(batch_end_us());
    collect(batch_begin_us, t_us_, packet);
    const auto& exposed = exposure_.interval();
    if (exposed && exposed->end_us == t_us_) packet.frames.push_back(exposure_.read_out());
  }
  return t_us_ > begin_us;
}

/// Batches end where an exposure begins or ends.
std::int64_t Simulator::batch_end_us() const {
  std::int64_t end_us = std::min((t_us_ / kBatch_us + 1) * kBatch_us, end_us_);
  if (const auto& exposed = exposure_.interval()) {
    end_us = std::min(end_us, exposed->begin_us > t_us_ ? exposed->begin_us : exposed->end_us);
  }
  return end_us;
}

void Simulator::simulate(std::int64_t end_us) {
  const std::vector<PlannedStep> plan = planner_.plan(end_us);
  const bool is_exposing = exposure_.interval() && exposure_.interval()->contains(t_us_);
  std::vector<std::future<void>> tasks;
  for (Block& block : blocks_) {
    tasks.push_back(pool_.submit([this, &block, &plan, is_exposing] { advance(block, plan, is_exposing); }));
  }
  for (std::future<void>& task : tasks) pool_.finish(std::move(task));
  steps_ += static_cast<std::int64_t>(plan.size());
  t_us_ = end_us;
}

void Simulator::advance(Block& block, const std::vector<PlannedStep>& steps, bool is_exposing) {
  block.events.clear();
  for (const PlannedStep& step : steps) {
    const float half_step_us = 0.5F * static_cast<float>(step.time.duration_us());
    for (int y = block.begin_row; y < block.end_row; ++y) {
      const std::span<float> light = light_of(y);
      if (is_exposing) exposure_.add(y, light, half_step_us);
      render_row(step.view, y, light);
      if (is_exposing) exposure_.add(y, light, half_step_us);
      pixels_.advance(y, light, step.time, block.events);
    }
  }
}

/// Sorts by time with one bin per microsecond, which keeps the order of rows and columns.
void Simulator::collect(std::int64_t begin_us, std::int64_t end_us, Packet& packet) {
  std::vector<std::size_t> place(static_cast<std::size_t>(end_us - begin_us) + 1, 0);
  for (const Block& block : blocks_) {
    for (const SensorEvent& event : block.events)
      ++place[static_cast<std::size_t>(event.t_us - begin_us) + 1];
  }
  place[0] = packet.events.size();
  std::partial_sum(place.begin(), place.end(), place.begin());
  packet.events.resize(place.back());
  causes_.resize(place.back());
  for (const Block& block : blocks_) {
    for (const SensorEvent& event : block.events) {
      const std::size_t i = place[static_cast<std::size_t>(event.t_us - begin_us)]++;
      packet.events[i] = {event.t_us, event.x, event.y, event.on};
      causes_[i] = event.cause;
    }
  }
}

}  // namespace esi

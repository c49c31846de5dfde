#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "esi/core/packet.hpp"
#include "esi/core/worker_pool.hpp"
#include "esi/sim/exposure.hpp"
#include "esi/sim/pixel_array.hpp"
#include "esi/sim/scenario.hpp"
#include "esi/sim/sim_options.hpp"
#include "esi/sim/step_plan.hpp"

namespace esi {

/// A recording that is made while it is read: pulled packet by packet, forward only, in bounded memory. The
/// same options give the same packets on any number of threads.
class Simulator {
 public:
  /// Throws a usage Error on options that contradict one another.
  Simulator(const SimOptions& options, int threads);

  SensorSize sensor_size() const { return scenario_.camera().size; }

  /// What is true; knows all times, not only those simulated so far.
  const Scenario& scenario() const { return scenario_; }
  const PixelArray& pixels() const { return pixels_; }

  /// Replaces the packet's content by about kPacketEvents events, sorted by time, then row, then column, and
  /// the intensity frames that ended meanwhile. Less where little happens. False, with an empty packet, at
  /// the end.
  bool next(Packet& packet);

  /// What made the events of the last packet, one by one.
  std::span<const EventCause> causes() const { return causes_; }

  std::int64_t t_us() const { return t_us_; }      ///< simulated so far
  std::int64_t end_us() const { return end_us_; }  ///< what will be simulated, perhaps less than the scenario
  /// The scenario's, as far as they are simulated.
  std::vector<Phase> phases() const;
  std::int64_t steps() const { return steps_; }  ///< of all pixels together

 private:
  /// Rows that one thread takes through several steps, while their pixels are in its cache.
  struct Block {
    int begin_row, end_row;
    std::vector<SensorEvent> events;
  };

  void settle();
  std::int64_t batch_end_us() const;
  void simulate(std::int64_t end_us);
  void advance(Block& block, const std::vector<PlannedStep>& steps, bool is_exposing);
  void collect(std::int64_t begin_us, std::int64_t end_us, Packet& packet);
  std::span<float> light_of(int y);

  Scenario scenario_;
  std::int64_t end_us_;
  PixelArray pixels_;
  Exposure exposure_;
  StepPlanner planner_;
  WorkerPool pool_;
  cv::Mat1f light_;  ///< at t_us_
  std::vector<Block> blocks_;
  std::vector<EventCause> causes_;
  std::int64_t t_us_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace esi

#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "esi/sweep/sweep_outcome.hpp"

namespace esi::test {

/// Names that mean something to some output format.
inline const std::string kEvilPhase = "a,\"b\" <script>alert('x')</script> & 50 %_$#{}\\^|*`";
inline const std::string kEvilRecording = "dir/r,\"1\" <b>&_%$#.h5";

/// Hits of so many frames of a recording's phase, for the numbers of the axes' values.
using MadeHits = std::function<std::int64_t(const std::vector<std::size_t>& position, std::size_t phase)>;

constexpr std::int64_t kMadeFrames = 1000;

inline SweepRate made_rate(std::int64_t hits, std::int64_t of) {
  SweepRate rate;
  rate.frames = {hits, of};
  if (of == 0) return rate;
  const double share = *rate.frames.value();
  rate.bootstrap = ConfidenceInterval{std::max(0.0, share - 0.03), std::min(1.0, share + 0.04)};
  rate.wrong = of - hits;
  if (hits > 0) rate.corner_error_px = 1.0 - 0.5 * share;
  return rate;
}

inline SweepRate made_sum(const std::vector<SweepRate>& rates) {
  std::int64_t hits = 0, of = 0;
  for (const SweepRate& rate : rates) hits += rate.frames.hits, of += rate.frames.of;
  return made_rate(hits, of);
}

/// Differences to the best have intervals of +- half a point.
inline void compare_to_best(SweepOutcome& outcome) {
  const double best = *rate_in(outcome.cells[outcome.best], objective_phase(outcome)).frames.value();
  for (CellOutcome& cell : outcome.cells) {
    const double difference = *rate_in(cell, objective_phase(outcome)).frames.value() - best;
    cell.to_best = {kMadeFrames, difference, ConfidenceInterval{difference - 0.005, difference + 0.005}};
    if (cell.cell == outcome.best) cell.to_best = {kMadeFrames, 0.0, ConfidenceInterval{0.0, 0.0}};
  }
}

/// Every phase but the last has kMadeFrames in each recording, the last none; the second recording finds two
/// less per phase.
inline SweepOutcome made_sweep(std::vector<SweepAxis> axes, const MadeHits& hits,
                               std::vector<std::string> phases = {"straight", kEvilPhase, "never"}) {
  SweepOutcome outcome;
  outcome.grid = SweepGrid(std::move(axes));
  outcome.method = "esi";
  outcome.objective = "total";
  outcome.recordings = {kEvilRecording, "second.aedat4"};
  outcome.phases = std::move(phases);
  for (std::size_t number = 0; number < outcome.grid.cells(); ++number) {
    CellOutcome& cell = outcome.cells.emplace_back();
    cell.cell = number;
    const auto position = outcome.grid.position(number);
    for (std::int64_t recording = 0; recording < 2; ++recording) {
      auto& rates = cell.by_recording.emplace_back();
      for (std::size_t phase = 0; phase < outcome.phases.size(); ++phase) {
        const bool is_empty = phase + 1 == outcome.phases.size();
        rates.push_back(is_empty ? made_rate(0, 0)
                                 : made_rate(hits(position, phase) - 2 * recording, kMadeFrames));
      }
      cell.totals.push_back(made_sum(rates));
    }
    for (std::size_t phase = 0; phase < outcome.phases.size(); ++phase) {
      cell.phases.push_back(made_sum({cell.by_recording[0][phase], cell.by_recording[1][phase]}));
    }
    cell.total = made_sum(cell.totals);
    if (cell.total.frames.hits > outcome.cells[outcome.best].total.frames.hits) outcome.best = number;
  }
  compare_to_best(outcome);
  return outcome;
}

inline SweepAxis made_numbers(std::string option, std::string unit, std::vector<std::string> values) {
  SweepAxis axis{std::move(option), std::move(unit), std::move(values), {}, false};
  for (const std::string& value : axis.values) axis.numbers.push_back(std::stod(value));
  return axis;
}

inline SweepAxis made_names(std::string option, std::vector<std::string> values) {
  return {std::move(option), "", std::move(values), {}, false};
}

/// tau_s matters below 2 s, less so with the form power; power costs 12 points at 2 s; readout doesn't
/// matter.
inline std::int64_t usual_hits(const std::vector<std::size_t>& position, std::size_t phase) {
  constexpr std::int64_t exponential[] = {500, 650, 810, 812}, power[] = {640, 670, 690, 692};
  const std::int64_t hits = position[1] == 0 ? exponential[position[0]] : power[position[0]];
  return hits + (position[2] == 0 ? 2 : 0) + (phase == 0 ? 100 : 0);
}

inline std::vector<SweepAxis> usual_axes() {
  return {made_numbers("tau_s", "s", {"0.5", "1", "2", "4"}), made_names("form", {"exponential", "power"}),
          made_names("readout_decay", {"true", "false"}), made_numbers("alpha", "", {"0.3"})};
}

inline SweepOutcome usual_sweep() { return made_sweep(usual_axes(), usual_hits); }

/// The cell saw the first half of the frames, all of its hits in them, and was dropped.
inline void drop(SweepOutcome& outcome, std::size_t number, std::int64_t round) {
  CellOutcome& cell = outcome.cells[number];
  cell.dropped_after_round = round;
  const auto halve = [](SweepRate& rate) {
    if (rate.frames.of > 0) rate = made_rate(rate.frames.hits / 2 + rate.frames.of / 20, rate.frames.of / 2);
  };
  for (SweepRate& rate : cell.phases) halve(rate);
  for (SweepRate& rate : cell.totals) halve(rate);
  for (auto& rates : cell.by_recording) {
    for (SweepRate& rate : rates) halve(rate);
  }
  halve(cell.total);
}

}  // namespace esi::test

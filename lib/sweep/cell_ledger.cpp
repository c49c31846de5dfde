#include "esi/sweep/cell_ledger.hpp"

#include <algorithm>
#include <optional>

#include "esi/sweep/cell_merit.hpp"

namespace esi {
namespace {

/// Between recordings on the joined clock; far more than any block of the bootstrap.
constexpr std::int64_t kPause_us = 3'600'000'000;

bool is_earlier(const FrameScore& a, const FrameScore& b) { return a.t_us < b.t_us; }

}  // namespace

PhaseRecord sum_of(const PhaseRecord& a, const PhaseRecord& b) {
  PhaseRecord sum{a.wrong + b.wrong, a.corners + b.corners, 0.0};
  if (sum.corners == 0) return sum;
  sum.corner_error_px = (static_cast<double>(a.corners) * a.corner_error_px +
                         static_cast<double>(b.corners) * b.corner_error_px) /
                        static_cast<double>(sum.corners);
  return sum;
}

CellLedger::CellLedger(std::size_t cells, const std::vector<SweptRecording>& recordings)
    : recordings_(recordings), tallies_(cells * recordings.size()) {}

void CellLedger::add(const CellRecord& record) {
  CellTally& tally = tallies_[record.cell * recordings_.size() + record.recording];
  const auto middle = static_cast<std::ptrdiff_t>(tally.frames.size());
  tally.frames.insert(tally.frames.end(), record.frames.begin(), record.frames.end());
  std::inplace_merge(tally.frames.begin(), tally.frames.begin() + middle, tally.frames.end(), is_earlier);
  tally.phases.resize(record.phases.size());
  for (std::size_t i = 0; i < record.phases.size(); ++i) {
    tally.phases[i] = sum_of(tally.phases[i], record.phases[i]);
  }
}

bool CellLedger::counts(std::size_t recording, std::size_t phase, const std::string& name) const {
  return name == "total" || recordings_[recording].phases[phase].name == name;
}

Score CellLedger::joined(std::size_t cell, const std::string& phase) const {
  Score score;
  std::int64_t shift_us = 0;
  for (std::size_t recording = 0; recording < recordings_.size(); ++recording) {
    const auto& phases = recordings_[recording].phases;
    const std::int64_t begin_us = phases.empty() ? 0 : phases.front().interval.begin_us;
    for (FrameScore frame : tally(cell, recording).frames) {
      if (!counts(recording, frame.phase, phase)) continue;
      frame.t_us += shift_us - begin_us;
      score.frames.push_back(frame);
    }
    if (!phases.empty()) shift_us += phases.back().interval.end_us - begin_us + kPause_us;
  }
  return score;
}

Rate CellLedger::rate(std::size_t cell, const std::string& phase) const {
  Rate rate;
  for (std::size_t recording = 0; recording < recordings_.size(); ++recording) {
    for (const FrameScore& frame : tally(cell, recording).frames) {
      if (!counts(recording, frame.phase, phase)) continue;
      ++rate.of;
      rate.hits += frame.is_detected ? 1 : 0;
    }
  }
  return rate;
}

PhaseRecord CellLedger::faults(std::size_t cell, const std::string& phase) const {
  PhaseRecord sum;
  for (std::size_t recording = 0; recording < recordings_.size(); ++recording) {
    const auto& phases = tally(cell, recording).phases;
    for (std::size_t i = 0; i < phases.size(); ++i) {
      if (counts(recording, i, phase)) sum = sum_of(sum, phases[i]);
    }
  }
  return sum;
}

std::vector<std::size_t> ranked(const CellLedger& ledger, std::vector<std::size_t> cells,
                                const std::string& objective) {
  std::vector<CellMerit> merits;
  for (const std::size_t cell : cells) {
    const PhaseRecord faults = ledger.faults(cell, objective);
    CellMerit& merit = merits.emplace_back();
    merit = {ledger.rate(cell, objective).value(), faults.wrong, std::nullopt, cell};
    if (faults.corners > 0) merit.corner_error_px = faults.corner_error_px;
  }
  std::sort(merits.begin(), merits.end(), is_better);
  std::transform(merits.begin(), merits.end(), cells.begin(),
                 [](const CellMerit& merit) { return merit.cell; });
  return cells;
}

std::size_t best_cell(const CellLedger& ledger, const std::vector<std::size_t>& cells,
                      const std::string& objective) {
  return ranked(ledger, cells, objective).front();
}

}  // namespace esi

#include "esi/sweep/sweep_results.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace esi {
namespace {

using Key = std::tuple<std::int64_t, std::size_t, std::size_t>;  // round, cell, recording

Key key_of(const CellRecord& record) { return {record.round, record.cell, record.recording}; }

std::vector<std::string> phase_names(const std::vector<SweptRecording>& recordings) {
  std::vector<std::string> names;
  for (const SweptRecording& recording : recordings) {
    for (const Phase& phase : recording.phases) {
      if (std::find(names.begin(), names.end(), phase.name) == names.end()) names.push_back(phase.name);
    }
  }
  return names;
}

SweepRate rate_of(const Rate& frames, const PhaseRecord& faults) {
  SweepRate rate{frames, std::nullopt, faults.wrong, std::nullopt};
  if (faults.corners > 0) rate.corner_error_px = faults.corner_error_px;
  return rate;
}

std::optional<ConfidenceInterval> bootstrap_of(const Score& joined, const BootstrapOptions& options) {
  std::vector<double> values;
  std::vector<std::int64_t> times_us;
  for (const FrameScore& frame : joined.frames) {
    values.push_back(frame.is_detected ? 1.0 : 0.0);
    times_us.push_back(frame.t_us);
  }
  return bootstrap_mean(values, times_us, options);
}

class Summary {
 public:
  Summary(const SweepHeader& header, const std::vector<CellRecord>& records)
      : header_(header), ledger_(header.config.grid().cells(), header.recordings) {
    for (const CellRecord& record : records) ledger_.add(record);
    outcome_.grid = header.config.grid();
    outcome_.method = std::string(header.config.base.method().name);
    outcome_.objective = header.config.search.objective;
    for (const SweptRecording& recording : header.recordings) outcome_.recordings.push_back(recording.path);
    outcome_.phases = phase_names(header.recordings);
  }

  SweepOutcome make(const std::vector<std::int64_t>& last_round) {
    std::vector<std::size_t> finalists;
    const std::int64_t final_round = *std::max_element(last_round.begin(), last_round.end());
    for (std::size_t cell = 0; cell < last_round.size(); ++cell) {
      if (last_round[cell] == final_round) finalists.push_back(cell);
    }
    outcome_.best = best_cell(ledger_, finalists, outcome_.objective);
    const Score best = ledger_.joined(outcome_.best, outcome_.objective);
    for (std::size_t cell = 0; cell < last_round.size(); ++cell) {
      CellOutcome own = rates_of(cell);
      own.to_best = paired_difference(ledger_.joined(cell, outcome_.objective), best, bootstrap());
      if (last_round[cell] < final_round) own.dropped_after_round = last_round[cell];
      outcome_.cells.push_back(std::move(own));
    }
    return std::move(outcome_);
  }

 private:
  const BootstrapOptions& bootstrap() const { return header_.config.score.bootstrap; }

  SweepRate pooled(std::size_t cell, const std::string& phase) const {
    SweepRate rate = rate_of(ledger_.rate(cell, phase), ledger_.faults(cell, phase));
    rate.bootstrap = bootstrap_of(ledger_.joined(cell, phase), bootstrap());
    return rate;
  }

  CellOutcome rates_of(std::size_t cell) const {
    CellOutcome own;
    own.cell = cell;
    for (const std::string& phase : outcome_.phases) own.phases.push_back(pooled(cell, phase));
    own.total = pooled(cell, "total");
    for (std::size_t recording = 0; recording < header_.recordings.size(); ++recording) {
      add_recording(own, recording);
    }
    return own;
  }

  void add_recording(CellOutcome& own, std::size_t recording) const {
    const CellTally& tally = ledger_.tally(own.cell, recording);
    std::vector<Rate> frames(outcome_.phases.size());
    std::vector<PhaseRecord> faults(outcome_.phases.size());
    PhaseRecord all_faults;
    Rate all_frames;
    const auto place_of = [&](std::size_t phase) {
      const std::string& name = header_.recordings[recording].phases[phase].name;
      const auto found = std::find(outcome_.phases.begin(), outcome_.phases.end(), name);
      return static_cast<std::size_t>(found - outcome_.phases.begin());
    };
    for (const FrameScore& frame : tally.frames) {
      for (Rate* rate : {&frames[place_of(frame.phase)], &all_frames}) {
        ++rate->of;
        rate->hits += frame.is_detected ? 1 : 0;
      }
    }
    for (std::size_t phase = 0; phase < tally.phases.size(); ++phase) {
      faults[place_of(phase)] = sum_of(faults[place_of(phase)], tally.phases[phase]);
      all_faults = sum_of(all_faults, tally.phases[phase]);
    }
    std::vector<SweepRate>& rates = own.by_recording.emplace_back();
    for (std::size_t i = 0; i < frames.size(); ++i) rates.push_back(rate_of(frames[i], faults[i]));
    own.totals.push_back(rate_of(all_frames, all_faults));
  }

  const SweepHeader& header_;
  CellLedger ledger_;
  SweepOutcome outcome_;
};

}  // namespace

SweepOutcome outcome_of(const SweepHeader& header, std::vector<CellRecord> records) {
  std::sort(records.begin(), records.end(),
            [](const CellRecord& a, const CellRecord& b) { return key_of(a) < key_of(b); });
  std::vector<std::int64_t> last_round(header.config.grid().cells(), 0);
  for (const CellRecord& record : records) last_round[record.cell] = record.round;
  return Summary(header, records).make(last_round);
}

std::vector<std::pair<std::size_t, std::size_t>> missing_cells(const SweepHeader& header,
                                                               const std::vector<CellRecord>& records) {
  std::set<Key> known;
  for (const CellRecord& record : records) known.insert(key_of(record));
  const SweepSearch search(header.config.search, header.config.score.bootstrap, header.config.judging.stride);
  CellLedger ledger(header.config.grid().cells(), header.recordings);
  std::vector<std::size_t> cells(header.config.grid().cells());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  std::vector<std::pair<std::size_t, std::size_t>> missing;
  for (std::int64_t round = 0; round < search.rounds() && missing.empty(); ++round) {
    for (const std::size_t cell : cells) {
      for (std::size_t recording = 0; recording < header.recordings.size(); ++recording) {
        if (!known.contains({round, cell, recording})) missing.emplace_back(cell, recording);
      }
    }
    for (const CellRecord& record : records) {
      if (record.round == round) ledger.add(record);
    }
    if (missing.empty() && round + 1 < search.rounds())
      cells = search.survivors(ledger, cells, round, header.config.grid().cells());
  }
  return missing;
}

}  // namespace esi

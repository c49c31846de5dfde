#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json_fwd.hpp>

#include "esi/sweep/sweep_header.hpp"
#include "esi/sweep/sweep_team.hpp"
#include "esi/sweep/sweep_work.hpp"

namespace esi {

/// Blocks of the leader of a team, for one of the others. See SweepDesk.
class RemoteWork final : public SweepWork {
 public:
  /// Throws an Error where the leader's sweep isn't this one: recordings that differ from machine to machine.
  RemoteWork(SweepTeam& team, const SweepHeader& header);

  std::optional<SweepBlock> next() override;
  void finish(const SweepBlock& block, std::vector<CellRecord> records, double seconds) override;
  void stop() override;

  /// The leader has no more blocks, or this process wants none.
  bool has_ended() const { return has_ended_; }
  /// Waits for that, but not longer; asks the leader now and then, which may have stopped.
  bool wait_for_end(std::chrono::milliseconds longest);

 private:
  nlohmann::json ask(const nlohmann::json& question);
  void end();

  SweepTeam& team_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> has_ended_{false};
  std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();  ///< for the state
};

}  // namespace esi

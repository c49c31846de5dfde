#pragma once

#include <functional>
#include <memory>

#include "esi/sweep/sweep_work.hpp"

namespace esi {

/// Processes, perhaps on several machines, that work on one sweep. The leader alone has the store; the others
/// ask it for blocks. Every one was started with the same options.
class SweepTeam {
 public:
  virtual ~SweepTeam() = default;

  virtual bool is_leader() const = 0;
  virtual int processes() const = 0;

  /// Of the leader: whether it could begin. Of the others: waits for the leader, whether it could.
  virtual bool begin(bool leader_can) = 0;

  /// Of the leader: answers the others until each has been told that there is no more. Calls `tick` now and
  /// then. Blocks that other processes had when they ended are lost with them.
  virtual void serve(SweepWork& work, const std::function<void()>& tick) = 0;

  /// Of the others: the leader's blocks.
  virtual std::unique_ptr<SweepWork> leaders_work() = 0;
};

}  // namespace esi

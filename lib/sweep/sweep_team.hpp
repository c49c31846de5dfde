#pragma once

#include <functional>
#include <string>

namespace esi {

/// Processes, perhaps on several machines, that work on one sweep. The leader alone has the store; the others
/// ask it. Every one was started with the same options. A team carries text: what is asked and answered is
/// SweepDesk's and RemoteWork's business.
class SweepTeam {
 public:
  using Answer = std::function<std::string(const std::string& question)>;

  virtual ~SweepTeam() = default;

  virtual bool is_leader() const = 0;
  virtual int processes() const = 0;

  /// Called by each that is ready; waits for all. False where any of them is not: then there is nothing to
  /// do.
  virtual bool begin() = 0;

  /// Of the leader: answers the others until each has left. Calls `tick` now and then. `answer` must not
  /// throw.
  virtual void serve(const Answer& answer, const std::function<void()>& tick) = 0;

  /// Of the others: the leader's answer. May be called by several threads at once.
  virtual std::string ask(const std::string& question) = 0;
};

}  // namespace esi

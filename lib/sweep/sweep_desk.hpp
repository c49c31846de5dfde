#pragma once

#include <exception>
#include <string>

#include "esi/sweep/sweep_queue.hpp"

namespace esi {

/// Where the processes of a team get their blocks from: answers a RemoteWork's questions out of the leader's
/// queue. An error ends the sweep for all of them and is kept.
class SweepDesk {
 public:
  /// What is referred to must outlive this.
  SweepDesk(SweepQueue& queue, const SweepHeader& header) : queue_(queue), header_(header) {}

  /// Questions and answers are JSON: {"ask": "join", "sweep": header}, {"ask": "next"}, {"ask": "finish",
  /// "block": ..., "records": [...], "seconds": 1.5}, {"ask": "state"}, {"ask": "stop"}; {"block": ...},
  /// {"end": false}, {"end": true} and, of a "join" with another sweep, {"end": true, "why": "..."}.
  /// Doesn't throw but for want of memory.
  std::string answer(const std::string& question);

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  nlohmann::json reply_to(const nlohmann::json& question);
  nlohmann::json welcome(const nlohmann::json& sweep);
  void take_records(const nlohmann::json& question);

  SweepQueue& queue_;
  const SweepHeader& header_;
  std::exception_ptr failure_;
};

}  // namespace esi

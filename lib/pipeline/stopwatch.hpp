#pragma once

#include <chrono>

namespace esi {

/// Wall time since it was made, for reports only: no result depends on it.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point began_ = Clock::now();
};

}  // namespace esi

#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

#include "esi/core/cpu_time.hpp"

namespace esi::bench {

/// Processor time of this thread.
inline double seconds(const std::function<void()>& work) {
  const double begin_s = thread_cpu_s();
  work();
  return thread_cpu_s() - begin_s;
}

/// What passes on the clock, whoever works.
inline double wall_seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

}  // namespace esi::bench

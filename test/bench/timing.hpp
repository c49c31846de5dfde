#pragma once

#include <algorithm>
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

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace esi::bench

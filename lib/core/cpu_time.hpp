#pragma once

#include <time.h>

namespace esi {

/// What the calling thread has used of a processor: others on the machine don't count.
inline double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace esi

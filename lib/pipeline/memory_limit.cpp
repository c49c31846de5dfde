#include "esi/pipeline/memory_limit.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {

void require_memory(std::uint64_t bytes, const std::string& what) {
  const auto pages = static_cast<std::uint64_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  std::uint64_t allowed = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0) allowed = std::min<std::uint64_t>(allowed, limit.rlim_cur);
  if (bytes <= allowed) return;
  constexpr double kGigabyte = 1e9;
  throw Error(fmt::format("{} needs {:.1f} GB of memory, and {:.1f} GB are there", what,
                          static_cast<double>(bytes) / kGigabyte, static_cast<double>(allowed) / kGigabyte));
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <string>

namespace esi {

/// Throws an Error "WHAT needs N GB, and M GB are allowed" when the machine's memory or the process's limit
/// (RLIMIT_AS) is smaller, before anything is allocated.
void require_memory(std::uint64_t bytes, const std::string& what);

}  // namespace esi

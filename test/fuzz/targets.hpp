#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace esi::fuzz {

/// What can be fuzzed: every row of the formats table, "zip", "config" and "ground-truth".
std::vector<std::string> targets();

/// Gives the bytes to a target. An Error is a fine answer; anything else that leaves this function, a broken
/// promise of the reader's included, ends the process. Returns how many events were read, or 1 for a config
/// or ground truth that was taken.
std::int64_t run(const std::string& target, std::span<const std::uint8_t> bytes);

}  // namespace esi::fuzz

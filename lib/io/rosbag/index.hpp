#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "esi/io/rosbag/record.hpp"

namespace esi {

/// All connections of a bag, from the index at byte `index_pos` of a regular file. Empty where there is no
/// sound index.
std::optional<std::vector<RosbagConnection>> read_rosbag_index(const std::filesystem::path& path,
                                                               std::uint64_t index_pos);

}  // namespace esi

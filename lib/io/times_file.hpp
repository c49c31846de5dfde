#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace esi {

/// Times of frames, one in seconds at the beginning of each line (what follows a blank is ignored, so that
/// timestamps.txt and images.txt both do); empty lines and lines with # are passed over. Ascending.
/// Throws a usage Error with the line.
std::vector<std::int64_t> read_times(const std::filesystem::path& path);

}  // namespace esi

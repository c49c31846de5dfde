#pragma once

#include <filesystem>

namespace esi {

/// Whether an .avi, .mp4 or .mkv file is as long as its own outermost lengths say. A writer that fails leaves
/// a file that is shorter, or one whose lengths it never filled in.
bool is_whole_video(const std::filesystem::path& path);

}  // namespace esi

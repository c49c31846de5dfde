#pragma once

#include <filesystem>
#include <memory>

#include "esi/io/writing/recording_writer.hpp"

namespace esi {

/// Text as RPG's data sets have it: "t x y p" a line in seconds, beside it images.txt ("t images/NAME") and
/// images/ as soon as there is an intensity frame. See formats.md section 4.
/// Throws a usage Error where images.txt or images is there already: they would pass for this recording's.
std::unique_ptr<RecordingWriter> open_rpg_text_writer(const std::filesystem::path& path,
                                                      const WriteOptions& options);

}  // namespace esi

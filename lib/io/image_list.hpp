#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "esi/io/format_reader.hpp"

namespace esi {

/// Adds to the events of a text recording the intensity frames that its folder's images.txt lists, as RPG's
/// data sets have them: "<seconds> images/frame_00000000.png" a line. Exposures are not known: they are empty
/// intervals. Pictures that are missing or unreadable are counted; those after the last event are left out.
/// An images.txt that is something else, or whose pictures are all absent, is only noted.
/// Returns `reader` itself where there is no images.txt.
std::unique_ptr<FormatReader> with_listed_images(std::unique_ptr<FormatReader> reader,
                                                 const std::filesystem::path& recording);

}  // namespace esi

#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// Text and csv: RPG/IJRR events.txt, rpg_e2vid (first line "W H"), t,x,y,p csv with a header line, and
/// Metavision csv (x,y,p,t, "%geometry:W,H"). See formats.md section 4.
bool looks_like_text(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_text(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace esi

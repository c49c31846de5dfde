#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "esi/io/byte_source.hpp"

namespace esi {

bool looks_like_zip(std::span<const std::byte> head);

/// The one file in a zip archive, which stands for that file: rpg_e2vid takes its recordings so.
/// Throws an Error for an archive that comes through a pipe, is damaged, encrypted, or holds any other number
/// of files. Damage within the file ends it early (ByteSource::damage).
std::unique_ptr<ByteSource> open_zip_entry(const ByteSource& archive);

}  // namespace esi

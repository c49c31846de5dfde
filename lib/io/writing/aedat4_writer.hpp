#pragma once

#include <filesystem>
#include <memory>

#include "esi/io/writing/recording_writer.hpp"

namespace esi {

/// AEDAT 4.0 with LZ4 packets: events in stream 0, intensity frames in stream 1. See formats.md section 1.
/// Throws a usage Error for a sensor that 16-bit signed coordinates can't hold.
std::unique_ptr<RecordingWriter> open_aedat4_writer(const std::filesystem::path& path,
                                                    const WriteOptions& options);

}  // namespace esi

#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// HDF5 files in the layouts of DSEC, TUM-VIE, EDS, e2calib, M3ED, MVSEC, Monash (event_utils) and
/// Metavision. See formats.md section 5.
bool looks_like_hdf5(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_hdf5(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace esi

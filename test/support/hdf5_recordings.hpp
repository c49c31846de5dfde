#pragma once

#include <span>
#include <string>

#include "esi/core/event.hpp"

namespace esi::test {

/// The bytes of HDF5 files that hold these events, written through HDF5's C API alone. Of a 240x180 sensor
/// where the layout has a size (not DSEC's, and MVSEC's only with its one image).

/// DSEC: four columns, gzip, t_offset.
std::string hdf5_recording(std::span<const Event> events);
/// MVSEC: rows of float64, gzip; one image.
std::string mvsec_recording(std::span<const Event> events);
/// Monash (event_utils): float64 seconds, booleans; sensor_resolution.
std::string monash_recording(std::span<const Event> events);
/// Metavision without ECF: records; geometry.
std::string metavision_hdf5_recording(std::span<const Event> events);

}  // namespace esi::test

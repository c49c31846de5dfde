#pragma once

#include <optional>
#include <string>
#include <vector>

#include "esi/io/hdf5/columns.hpp"
#include "esi/io/hdf5/layout.hpp"

namespace esi {

/// Whether all four columns are there.
bool has_columns(const Hdf5File& file, const Hdf5ColumnPaths& paths);

/// Throws a usage Error where --stream is given.
void refuse_stream(const Hdf5File& file, const ReadOptions& options);

/// The stream that --stream says, or the only one of those that are present. Throws a usage Error.
std::string choose_stream(const Hdf5File& file, const ReadOptions& options,
                          const std::vector<std::string>& present);

/// Sets the header's sensor, or notes that what `path` holds is no size.
void use_sensor_size(double width_px, double height_px, const std::string& path, RecordingHeader& header);

/// The size that the recording will be given: --size, else the file's own.
std::optional<SensorSize> expected_size(const ReadOptions& options, const RecordingHeader& header);

}  // namespace esi

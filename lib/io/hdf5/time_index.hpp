#pragma once

#include <string>

#include "esi/io/hdf5/file.hpp"

namespace esi {

/// DSEC's ms_to_idx: entry ms is the first event that is not before ms milliseconds (of the times without
/// t_offset). It is not used for reading; this compares a few entries with the times.
/// Returns a sentence when they contradict each other, or when the index can't be read; else nothing.
std::string check_time_index(const Hdf5File& file, const std::string& index_path,
                             const std::string& times_path);

}  // namespace esi

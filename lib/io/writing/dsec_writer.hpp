#pragma once

#include <filesystem>
#include <memory>

#include "esi/io/writing/recording_writer.hpp"

namespace esi {

/// HDF5 of DSEC's layout: /events/{x,y,p,t}, /ms_to_idx, /t_offset. See formats.md section 5.
std::unique_ptr<RecordingWriter> open_dsec_writer(const std::filesystem::path& path,
                                                  const WriteOptions& options);

}  // namespace esi

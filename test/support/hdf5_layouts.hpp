#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "esi/core/event.hpp"
#include "support/hdf5_file.hpp"

namespace esi::test {

/// Pieces of the layouts of MVSEC, Monash and Metavision, as docs/formats.md section 5 has them.

/// x, y, t in seconds, p -1 or 1.
using MvsecRow = std::array<double, 4>;
std::vector<MvsecRow> mvsec_rows(std::span<const Event> events);

/// `chunk`: rows; gzip.
void write_mvsec(Hdf5Writer& file, const std::string& path, const std::vector<MvsecRow>& rows, hsize_t chunk);

/// image_raw, of `extent` N x height x width, and image_raw_ts in seconds. `group` ends in "/". Without a
/// chunk, contiguous; else gzip.
void write_images(Hdf5Writer& file, const std::string& group, const std::vector<hsize_t>& extent,
                  const std::vector<std::uint8_t>& images, const std::vector<double>& times_s,
                  const std::vector<hsize_t>& chunk = {});

/// HDF5's enumeration FALSE, TRUE of int8, as h5py writes booleans. To be closed with H5Tclose.
hid_t boolean_type();

/// /events/xs, ys (int16), ts (float64 seconds), ps (boolean).
void write_monash(Hdf5Writer& file, std::span<const Event> events);

/// /CD/events of 16 bytes: x, y (uint16), p (int16), t (int64).
void write_metavision(Hdf5Writer& file, std::span<const Event> events, hsize_t chunk);

/// One number, or an array of several, as float64.
void write_attribute(Hdf5Writer& file, const std::string& object, const std::string& name,
                     const std::vector<double>& values);
/// Of variable length, as h5py and HighFive write it, or of the text's own.
void write_text_attribute(Hdf5Writer& file, const std::string& object, const std::string& name,
                          const std::string& text, bool is_variable = true);

}  // namespace esi::test

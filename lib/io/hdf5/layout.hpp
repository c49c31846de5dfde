#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "esi/io/format_reader.hpp"
#include "esi/io/hdf5/event_table.hpp"
#include "esi/io/hdf5/file.hpp"

namespace esi {

/// One row of the table of HDF5 layouts. See formats.md section 5.
struct Hdf5Layout {
  std::string_view name;      ///< as in RecordingHeader::layout
  std::string_view datasets;  ///< what it is recognised by, for messages
  bool (*recognises)(const Hdf5File& file);
  /// Fills in the header's sensor and notes. The header must outlive the table, which may add notes.
  std::unique_ptr<Hdf5EventTable> (*open)(const Hdf5File& file, const ReadOptions& options,
                                          RecordingHeader& header);
};

/// Every known layout, most specific first.
std::span<const Hdf5Layout> hdf5_layouts();

/// The file's layout. Throws an Error that lists the file's datasets and the known layouts.
const Hdf5Layout& find_hdf5_layout(const Hdf5File& file);

}  // namespace esi

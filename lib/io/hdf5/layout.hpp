#pragma once

#include <memory>
#include <string_view>

#include "esi/io/format_reader.hpp"
#include "esi/io/hdf5/event_table.hpp"
#include "esi/io/hdf5/file.hpp"
#include "esi/io/hdf5/images.hpp"

namespace esi {

/// What an HDF5 file has for us. Both need the file and the header that they were opened with.
struct Hdf5Content {
  std::unique_ptr<Hdf5EventTable> events;
  std::unique_ptr<Hdf5FrameTrack> frames;  ///< none where the file has none
};

/// One HDF5 layout. See formats.md section 5.
struct Hdf5Layout {
  std::string_view name;      ///< as in RecordingHeader::layout
  std::string_view datasets;  ///< what it is recognised by, for messages
  bool (*recognises)(const Hdf5File& file);
  /// Fills in the header's sensor and notes, which may grow later.
  Hdf5Content (*open)(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header);
};

extern const Hdf5Layout kDsecLayout, kM3edLayout, kRootLayout, kMvsecLayout, kMonashLayout, kMetavisionLayout;

/// The file's layout. Throws an Error that lists the file's datasets and the known layouts.
const Hdf5Layout& find_hdf5_layout(const Hdf5File& file);

}  // namespace esi

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "esi/core/event.hpp"
#include "esi/core/packet.hpp"

namespace esi {

struct WriteOptions {
  SensorSize size;               ///< of the sensor, and of every intensity frame
  std::int64_t t_offset_us = 0;  ///< what a reader adds to the times that are given, such as an epoch
  std::string camera_name = "simulated";  ///< where the format has a place for one
};

/// Writes a recording packet by packet, in bounded memory (but for AEDAT 4's table, some 40 bytes per packet
/// of the file). The same packets and options give the same bytes.
class RecordingWriter {
 public:
  /// Without finish() nothing stays behind.
  virtual ~RecordingWriter() = default;

  /// Events in order of time; beside them, intensity frames in order of their exposures' ends. A reader gives
  /// both back as they are, with t_offset_us added. Throws an Error for what is not in order, lies outside
  /// the sensor or does not fit into the format, and for failed writes. Then nothing more can be written.
  virtual void write(const Packet& packet) = 0;

  /// Lets the recording appear under its name. Nothing can be written after it.
  virtual void finish() = 0;
};

/// Whether recordings of that name can hold intensity frames: HDF5 of DSEC's layout can't.
bool holds_intensity_frames(const std::filesystem::path& path);

/// Begins a recording; its name's extension says in which format:
/// .h5, .hdf5: HDF5 of DSEC's layout, events only, no time below 0; .aedat4: AEDAT 4 with frames, sides up to
/// 32767 px; .txt: RPG's text, with 8-bit frames as images/frame_00000000.png and images.txt beside it, which
/// must not be there yet. There a frame has one time, its exposure's middle.
/// Replaces a file of that name. Throws a usage Error for other names and options that the format can't hold,
/// and an Error where the file cannot be made.
std::unique_ptr<RecordingWriter> open_recording_writer(const std::filesystem::path& path,
                                                       const WriteOptions& options);

}  // namespace esi

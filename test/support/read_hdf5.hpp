#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/reader.hpp"
#include "support/hdf5_file.hpp"

namespace esi::test {

/// All that the HDF5 reader makes of a file.
struct Reading {
  std::vector<Event> events;
  std::vector<IntensityFrame> frames;
  std::vector<std::int64_t> newest_event_us;  ///< given out when the frame of the same index came
  Losses losses;
  RecordingHeader header;
  std::size_t largest_packet = 0;
  std::size_t largest_frame_count = 0;
};

inline Reading read_hdf5(const std::filesystem::path& path, const ReadOptions& options = {}) {
  const auto reader = open_hdf5(std::make_unique<ByteSource>(path), options);
  Reading reading;
  Packet packet;
  while (reader->read(packet, reading.losses)) {
    reading.largest_packet = std::max(reading.largest_packet, packet.events.size());
    reading.events.insert(reading.events.end(), packet.events.begin(), packet.events.end());
    reading.largest_frame_count = std::max(reading.largest_frame_count, packet.frames.size());
    for (const IntensityFrame& frame : packet.frames) {
      reading.frames.push_back(frame);
      reading.newest_event_us.push_back(reading.events.empty() ? INT64_MIN : reading.events.back().t_us);
    }
    packet.clear();
  }
  reading.header = reader->header();
  return reading;
}

/// The message of the Error that reading a file ends with; empty where there is none.
inline std::string hdf5_error(const std::filesystem::path& path, const ReadOptions& options = {},
                              Error::Kind kind = Error::Kind::failure) {
  try {
    read_hdf5(path, options);
  } catch (const Error& error) {
    return error.kind() == kind ? error.what() : std::string("an Error of the wrong kind: ") + error.what();
  }
  return {};
}

/// What the reader must make of rows [begin, end) of the columns.
inline std::vector<Event> expected_events(const Columns& columns, std::size_t begin, std::size_t end) {
  std::vector<Event> events;
  for (std::size_t i = begin; i < end; ++i) {
    events.push_back({columns.t[i], static_cast<std::uint16_t>(columns.x[i]),
                      static_cast<std::uint16_t>(columns.y[i]), columns.p[i] > 0});
  }
  return events;
}

inline std::vector<Event> expected_events(const Columns& columns) {
  return expected_events(columns, 0, columns.t.size());
}

}  // namespace esi::test

#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "esi/io/format_reader.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

/// All that a reader gives of a file.
struct FormatReading {
  Packet all;
  Losses losses;
  RecordingHeader header;
  std::size_t most_events_at_once = 0;

  std::string notes() const {
    std::string text;
    for (const std::string& note : header.notes) text += note + "\n";
    return text;
  }
};

/// How a format is opened.
using OpenFormat = std::unique_ptr<FormatReader> (*)(std::unique_ptr<ByteSource>, const ReadOptions&);

inline FormatReading read_with(OpenFormat open, const std::filesystem::path& path,
                               const ReadOptions& options = {}) {
  const auto reader = open(std::make_unique<ByteSource>(path), options);
  FormatReading reading;
  std::size_t before = 0;
  while (reader->read(reading.all, reading.losses)) {
    reading.most_events_at_once = std::max(reading.most_events_at_once, reading.all.events.size() - before);
    before = reading.all.events.size();
  }
  reading.header = reader->header();
  return reading;
}

/// Of a file with these bytes.
inline FormatReading read_bytes_with(OpenFormat open, const std::string& bytes,
                                     const ReadOptions& options = {}) {
  const TempFolder folder;
  return read_with(open, folder.write("recording", bytes), options);
}

}  // namespace esi::test

#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "esi/io/aedat4/reader.hpp"
#include "support/aedat4_file.hpp"
#include "support/read_format.hpp"

namespace esi::test {

inline FormatReading read_aedat4(const std::filesystem::path& path, const ReadOptions& options = {}) {
  return read_with(open_aedat4, path, options);
}

/// Of a file with these bytes.
inline FormatReading read_aedat4_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  return read_bytes_with(open_aedat4, bytes, options);
}

/// `count` events from t_us on, 10 us apart, all different.
inline std::vector<Aedat4Event> some_aedat4_events(std::int64_t t_us, int count) {
  std::vector<Aedat4Event> events(static_cast<std::size_t>(count));
  std::int64_t i = 0;
  for (Aedat4Event& event : events) {
    event = {t_us + 10 * i, static_cast<std::int16_t>(i * 7 % 346), static_cast<std::int16_t>(i * 11 % 260),
             static_cast<std::uint8_t>(i % 3 == 0)};
    ++i;
  }
  return events;
}

/// What a reader should make of them.
inline std::vector<Event> as_read(const std::vector<Aedat4Event>& stored) {
  std::vector<Event> events;
  events.reserve(stored.size());
  for (const Aedat4Event& event : stored) {
    events.push_back({event.t_us, static_cast<std::uint16_t>(event.x), static_cast<std::uint16_t>(event.y),
                      event.polarity != 0});
  }
  return events;
}

}  // namespace esi::test

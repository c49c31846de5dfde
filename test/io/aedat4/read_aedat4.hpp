#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "esi/io/aedat4/reader.hpp"
#include "support/aedat4_file.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

/// All that the reader gives of a file.
struct Aedat4Content {
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

inline Aedat4Content read_aedat4(const std::filesystem::path& path, const ReadOptions& options = {}) {
  const auto reader = open_aedat4(std::make_unique<ByteSource>(path), options);
  Aedat4Content content;
  std::size_t before = 0;
  while (reader->read(content.all, content.losses)) {
    content.most_events_at_once = std::max(content.most_events_at_once, content.all.events.size() - before);
    before = content.all.events.size();
  }
  content.header = reader->header();
  return content;
}

/// Of a file with these bytes.
inline Aedat4Content read_aedat4_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  const TempFolder folder;
  return read_aedat4(folder.write("recording.aedat4", bytes), options);
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

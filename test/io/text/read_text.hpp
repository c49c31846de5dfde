#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "esi/io/text/reader.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

/// All that the reader gives of a text.
struct TextContent {
  std::vector<Event> events;
  Losses losses;
  RecordingHeader header;
  std::size_t most_events_at_once = 0;

  std::string notes() const {
    std::string text;
    for (const std::string& note : header.notes) text += note + "\n";
    return text;
  }
};

inline TextContent read_text_path(const std::filesystem::path& path, const ReadOptions& options = {}) {
  const auto reader = open_text(std::make_unique<ByteSource>(path), options);
  TextContent content;
  Packet packet;
  while (reader->read(packet, content.losses)) {
    content.most_events_at_once = std::max(content.most_events_at_once, packet.events.size());
    content.events.insert(content.events.end(), packet.events.begin(), packet.events.end());
    packet.clear();
  }
  content.header = reader->header();
  return content;
}

/// Of a file with these bytes.
inline TextContent read_text(std::string_view bytes, const ReadOptions& options = {}) {
  const TempFolder folder;
  return read_text_path(folder.write("events.txt", bytes), options);
}

/// For recordings too short for their unit to be plausible.
inline ReadOptions in_unit(TimeUnit unit) {
  ReadOptions options;
  options.time_unit = unit;
  return options;
}

inline std::ostream& operator<<(std::ostream& stream, const Event& event) {
  return stream << event.t_us << " " << event.x << " " << event.y << " " << event.on;
}

}  // namespace esi::test

namespace esi {
using test::operator<<;
}

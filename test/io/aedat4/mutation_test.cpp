// Whatever is done to a file: events, or an Error. The sanitizers watch.
#include <catch2/catch.hpp>
#include <random>

#include "esi/core/error.hpp"
#include "io/aedat4/read_aedat4.hpp"

namespace esi::test {
namespace {

/// Events, a frame and an ignored stream; `ends` gets where each packet ends and how many events there are up
/// to it.
std::string small_file(Aedat4Compression compression,
                       std::vector<std::pair<std::size_t, std::size_t>>& ends) {
  Aedat4File file(compression,
                  aedat4_xml(aedat4_stream_xml(0, "EVTS", "346x260") +
                             aedat4_stream_xml(1, "FRME", "346x260") + aedat4_stream_xml(2, "IMUS", "")));
  ends.emplace_back(file.position(), 0);
  std::size_t events = 0;
  const auto add = [&](std::int32_t stream, const std::string& buffer) {
    file.add(stream, buffer);
    ends.emplace_back(file.position(), events);
  };
  for (int i = 0; i < 3; ++i) {
    events += 20;
    add(0, aedat4_event_buffer(some_aedat4_events(1000 + 1000 * i, 20)));
    Aedat4Frame frame;
    frame.t_us = 1500 + 1000 * i;
    frame.width_px = 5;
    frame.height_px = 4;
    frame.pixels = std::string(20, '\x42');
    add(1, aedat4_frame_buffer(frame));
    add(2, "samples");
  }
  return file.bytes();
}

}  // namespace

TEST_CASE("An AEDAT 4 file cut after any byte gives all whole packets before the cut") {
  const auto compression = GENERATE(Aedat4Compression::none, Aedat4Compression::lz4, Aedat4Compression::zstd);
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  const std::string whole = small_file(compression, ends);
  const std::vector<Event> events = read_aedat4_bytes(whole).all.events;
  REQUIRE(events.size() == 60);
  const TempFolder folder;
  const auto path = folder.write("cut.aedat4", whole);
  const std::size_t table = ends.back().first;
  for (std::size_t length = whole.size(); length >= 14; --length) {
    INFO("first " << length << " of " << whole.size() << " bytes");
    std::filesystem::resize_file(path, length);
    if (length < ends.front().first) {
      CHECK_THROWS_AS(read_aedat4(path), Error);
      continue;
    }
    const auto after =
        std::find_if(ends.begin(), ends.end(), [&](const auto& end) { return end.first > length; });
    const FormatReading cut = read_aedat4(path);
    REQUIRE(cut.all.events.size() == std::prev(after)->second);
    CHECK(std::equal(cut.all.events.begin(), cut.all.events.end(), events.begin()));
    CHECK(cut.losses.text() == (length < table ? "1 cut_packet" : ""));
  }
}

TEST_CASE("Random damage to an AEDAT 4 file gives events or an Error") {
  const auto compression = GENERATE(Aedat4Compression::none, Aedat4Compression::lz4, Aedat4Compression::zstd);
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  const std::string whole = small_file(compression, ends);
  const TempFolder folder;
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0, refused = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string bytes = whole;
    // The XML is long: two of three cases spare it.
    const std::size_t first = below(3) == 0 ? 0 : ends.front().first;
    for (std::size_t n = 1 + below(6); n > 0; --n) {
      bytes[first + below(bytes.size() - first)] = static_cast<char>(random());
    }
    if (below(8) == 0) bytes.resize(14 + below(bytes.size() - 14));
    try {
      const FormatReading content = read_aedat4(folder.write(std::to_string(i), bytes));
      // What is not compressed gives at most an event for every 16 bytes; a frame decodes into 64 KB blocks.
      REQUIRE(content.all.events.size() <= 4096);
      REQUIRE(content.all.frames.size() <= 3);
      REQUIRE(content.header.notes.size() <= 8);
      ++read;
    } catch (const Error&) {
      ++refused;
    }
  }
  CHECK(read > 500);
  CHECK(refused > 50);
}

}  // namespace esi::test

// Whatever is done to a file: events, or an Error. The sanitizers watch.
#include <catch2/catch.hpp>
#include <random>

#include "io/aedat3/read_aedat3.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

/// `ends`: where each packet ends, and how many events there are up to it.
std::string small_file(std::vector<std::pair<std::size_t, std::size_t>>& ends) {
  std::string bytes = aedat3_davis_header();
  ends = {{bytes.size(), 0}};
  std::size_t events = 0;
  const auto add = [&](const std::string& packet, std::size_t count) {
    bytes += packet;
    events += count;
    ends.emplace_back(bytes.size(), events);
  };
  Aedat3FrameEvent frame;
  frame.width_px = 3;
  frame.height_px = 2;
  frame.pixels = {1, 2, 3, 4, 5, 6};
  for (int i = 0; i < 3; ++i) {
    add(aedat3_packet(some_aedat3_events(1000 + 1000 * i, 6)), 6);
    add(aedat3_frame_packet(frame), 0);
    add(aedat3_packet(some_aedat3_events(1, 2), 1, 0), 0);
  }
  return bytes;
}

}  // namespace

TEST_CASE("An AEDAT 3.1 file cut after any byte gives all events before the cut, or an Error") {
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  const std::string whole = small_file(ends);
  const std::vector<Event> events = read_aedat3_bytes(whole).all.events;
  REQUIRE(events.size() == 18);
  const TempFolder folder;
  const auto path = folder.write("cut.aedat", whole);
  for (std::size_t length = whole.size(); length-- > 1;) {
    INFO("first " << length << " of " << whole.size() << " bytes");
    std::filesystem::resize_file(path, length);
    if (length <= ends.front().first) {
      CHECK_THROWS_WITH(read_aedat3(path), Contains("cut.aedat: "));
      continue;
    }
    const auto end = std::prev(
        std::find_if(ends.begin(), ends.end(), [length](const auto& e) { return e.first > length; }));
    const std::size_t bytes_of_next = length - end->first;
    const bool is_in_events = std::next(end)->second > end->second && bytes_of_next > 28;
    const FormatReading cut = read_aedat3(path);
    REQUIRE(cut.all.events.size() == end->second + (is_in_events ? (bytes_of_next - 28) / 8 : 0));
    CHECK(std::equal(cut.all.events.begin(), cut.all.events.end(), events.begin()));
    CHECK(cut.losses.text() == (bytes_of_next > 0 ? "1 cut_packet" : ""));
    CHECK(cut.header.notes.size() == (bytes_of_next > 0 ? 1 : 0));
    if (bytes_of_next > 0) CHECK_THAT(cut.notes(), Contains("at byte " + std::to_string(end->first)));
    CHECK(cut.all.packet_ends_us.size() == end->second / 6);
  }
}

TEST_CASE("An AEDAT 3.1 packet whose numbers can't be is where reading stops") {
  Aedat3Head head;
  head.events = head.valid = head.capacity = 2;
  SECTION("more valid events than events") { head.valid = 3; }
  SECTION("negative number of valid events") { head.valid = -1; }
  SECTION("negative number of events") { head.events = -2; }
  SECTION("more events than room") { head.capacity = 1; }
  SECTION("negative room") { head.capacity = -1; }
  SECTION("no bytes an event") { head.event_bytes = 0; }
  SECTION("negative bytes an event") { head.event_bytes = -8; }
  SECTION("negative bytes an event, none of them") {
    head.event_bytes = -8;
    head.events = head.valid = 0;
  }
  SECTION("another size of polarity events") { head.event_bytes = 12; }
  SECTION("frames without their head") {
    head.type = 2;
    head.event_bytes = 35;
  }
  SECTION("huge events") {
    head.type = 2;
    head.event_bytes = (1 << 26) + 1;
    head.events = head.valid = 1;
  }
  SECTION("counts that overflow") {
    head.type = 3;
    head.event_bytes = 1 << 16;
    head.events = head.capacity = head.valid = INT32_MAX;
  }
  SECTION("more bytes than any packet has") { head.events = head.capacity = (1 << 27) + 1; }
  SECTION("negative overflow") { head.overflow = -1; }
  SECTION("compressed") { head.type = static_cast<std::int16_t>(0x8001); }
  const auto events = some_aedat3_events(1000, 4);
  const std::string before = aedat3_davis_header() + aedat3_packet(events);
  const FormatReading content =
      read_aedat3_bytes(before + aedat3_head(head) + std::string(16, '\1') + aedat3_packet(events));
  CHECK(content.all.events == events);
  CHECK(content.losses.text() == "1 corrupt_packet");
  CHECK_THAT(content.notes(), Contains("at byte " + std::to_string(before.size())) && Contains("can't be"));
}

TEST_CASE("An AEDAT 3.1 packet that claims more than the file has is cut") {
  const auto type = GENERATE(as<std::int16_t>{}, 1, 2, 6);
  Aedat3Head head;
  head.type = type;
  head.event_bytes = type == 2 ? 1 << 26 : 8;
  head.events = head.capacity = type == 2 ? 16 : 1 << 27;
  const std::string event = aedat3_event(7, 1, 2, true);
  const FormatReading content = read_aedat3_bytes(aedat3_davis_header() + aedat3_head(head) + event + "123");
  CHECK(content.all.events.size() == (type == 1 ? 1 : 0));
  CHECK(content.losses.text() == "1 cut_packet");
}

TEST_CASE("Random damage to an AEDAT 3.1 file gives events or an Error") {
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  const std::string whole = small_file(ends);
  const TempFolder folder;
  std::mt19937 random(20240609);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    const std::size_t first = below(3) == 0 ? 0 : ends.front().first;
    for (std::size_t n = 1 + below(6); n > 0; --n) {
      bytes[first + below(bytes.size() - first)] = static_cast<char>(random());
    }
    if (below(8) == 0) bytes.resize(1 + below(bytes.size()));
    try {
      const FormatReading content = read_aedat3(folder.write("recording", bytes));
      REQUIRE(content.all.events.size() <= bytes.size() / 8);
      REQUIRE(content.all.frames.size() <= 9);
      REQUIRE(content.header.notes.size() <= 4);
      ++read;
    } catch (const Error& error) {
      CHECK_THAT(error.what(), Contains("recording: "));
      ++refused;
    }
  }
  CHECK(read > 1000);
  CHECK(refused > 100);
}

}  // namespace esi::test

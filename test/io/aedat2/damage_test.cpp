// Whatever is done to a file: events, or an Error. The sanitizers watch.
#include <catch2/catch.hpp>
#include <random>

#include "io/aedat2/read_aedat2.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

const std::string kHeader = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");

/// Twelve records: seven events, an external signal, and readings of the only pixel of a 1x1 sensor.
std::string small_file() {
  std::string bytes = kHeader;
  for (std::uint32_t i = 0; i < 3; ++i) {
    bytes += aedat2_record(davis_address(3, 5, i % 2 == 0), 100 + i);
    bytes += aedat2_record(davis_reset_read(0, 0, 900), 110 + i);
    bytes += aedat2_record(0x400, 115 + i) + aedat2_record(davis_signal_read(0, 0, 100), 120 + i);
  }
  return bytes;
}

}  // namespace

TEST_CASE("An AEDAT 2 file cut after any byte gives the events before the cut, or an Error") {
  const std::string whole = small_file();
  const std::vector<Event> events = read_aedat2_bytes(whole).all.events;
  REQUIRE(events.size() == 3);
  const TempFolder folder;
  const auto path = folder.write("cut.aedat", whole);
  for (std::size_t length = whole.size(); length-- > 1;) {
    INFO("first " << length << " of " << whole.size() << " bytes");
    std::filesystem::resize_file(path, length);
    if (length <= kHeader.size()) {
      CHECK_THROWS_WITH(read_aedat2(path), Contains("cut.aedat: "));
      continue;
    }
    const std::size_t records = (length - kHeader.size()) / 8;
    const FormatReading cut = read_aedat2(path);
    REQUIRE(cut.all.events.size() == (records + 3) / 4);
    CHECK(std::equal(cut.all.events.begin(), cut.all.events.end(), events.begin()));
    const bool is_within_record = (length - kHeader.size()) % 8 != 0;
    CHECK(cut.losses.text() == (is_within_record ? "1 cut_packet" : ""));
    const std::string note = "within the record at byte " + std::to_string(kHeader.size() + 8 * records);
    CHECK((cut.notes().find(note) != std::string::npos) == is_within_record);
  }
}

TEST_CASE("Random damage to an AEDAT 2 file gives events or an Error") {
  const std::string whole = small_file();
  const TempFolder folder;
  std::mt19937 random(20240608);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    const std::size_t first = below(3) == 0 ? 0 : kHeader.size();
    for (std::size_t n = 1 + below(6); n > 0; --n) {
      bytes[first + below(bytes.size() - first)] = static_cast<char>(random());
    }
    if (below(8) == 0) bytes.resize(1 + below(bytes.size()));
    const ReadOptions options = below(2) == 0 ? ReadOptions() : with_chip("DAVIS240", "1x1");
    try {
      const FormatReading content = read_aedat2(folder.write("recording", bytes), options);
      REQUIRE(content.all.events.size() <= bytes.size() / 8);
      REQUIRE(content.all.frames.size() <= 6);
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

TEST_CASE("A large AEDAT 2 sensor whose frames begin again and again costs no more time than its bytes") {
  std::string records;
  for (int i = 0; i < 200'000; ++i) records += aedat2_record(davis_reset_read(i % 2, 0, 1), 1);
  const FormatReading content = read_aedat2_bytes(kHeader + records, with_chip("DAVIS640", "1024x512"));
  CHECK(content.all.frames.empty());
  CHECK(content.header.notes.size() == 1);
}

}  // namespace esi::test

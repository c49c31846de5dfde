// Whatever is done to a file: events, or an Error. The sanitizers watch.
#include <catch2/catch.hpp>
#include <random>

#include "esi/core/error.hpp"
#include "esi/io/prophesee/dat_reader.hpp"
#include "esi/io/prophesee/raw_reader.hpp"
#include "support/prophesee_file.hpp"
#include "support/random_events.hpp"
#include "support/read_format.hpp"

namespace esi::test {
namespace {

struct SmallFile {
  const char* name;
  OpenFormat open;
  std::string bytes;
  std::size_t data;  ///< where they begin
  std::size_t word_bytes;
  std::size_t most_events;  ///< of a word
};

SmallFile small_file(int index) {
  const auto events = random_events({0, 0, 240, 180}, 60, 50, 1);
  const auto data_of = [](const std::string& bytes) { return bytes.find("% end\n") + 6; };
  const std::string evt2 = evt2_recording(events), evt21 = evt21_recording(events);
  const std::string evt3 = evt3_recording(events), dat = dat_recording(events);
  if (index == 0) return {"EVT2", open_prophesee_raw, evt2, data_of(evt2), 4, 1};
  if (index == 1) return {"EVT2.1", open_prophesee_raw, evt21, data_of(evt21), 8, 32};
  if (index == 2) return {"EVT3", open_prophesee_raw, evt3, data_of(evt3), 2, 12};
  return {"DAT", open_prophesee_dat, dat, dat.size() - 8 * events.size(), 8, 1};
}

}  // namespace

TEST_CASE("a RAW or DAT file cut after any byte gives all whole words before the cut") {
  const SmallFile file = small_file(GENERATE(0, 1, 2, 3));
  CAPTURE(file.name);
  const std::vector<Event> events = read_bytes_with(file.open, file.bytes).all.events;
  REQUIRE(events.size() == 60);
  const TempFolder folder;
  std::size_t before = 0;
  for (std::size_t length = 1; length <= file.bytes.size(); ++length) {
    CAPTURE(length);
    const auto path = folder.write("cut", file.bytes.substr(0, length));
    try {
      const FormatReading cut = read_with(file.open, path);
      const auto& got = cut.all.events;
      REQUIRE(got.size() >= before);
      REQUIRE(got.size() <= before + file.most_events);
      REQUIRE(std::equal(got.begin(), got.end(), events.begin()));
      before = got.size();
      const bool is_cut = length > file.data && (length - file.data) % file.word_bytes != 0;
      if (length >= file.data) REQUIRE(cut.losses.text() == (is_cut ? "1 cut_packet" : ""));
    } catch (const Error& error) {
      REQUIRE(length < file.data);
      REQUIRE(std::string(error.what()).starts_with(path.string()));
    }
  }
  CHECK(before == events.size());
}

TEST_CASE("random damage to a RAW or DAT file gives events or an Error") {
  const SmallFile file = small_file(GENERATE(0, 1, 2, 3));
  CAPTURE(file.name);
  const TempFolder folder;
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = file.bytes;
    for (std::size_t n = 1 + below(6); n > 0; --n) bytes[below(bytes.size())] = static_cast<char>(random());
    if (below(8) == 0) bytes.resize(1 + below(bytes.size()));
    try {
      const FormatReading reading = read_with(file.open, folder.write("damaged", bytes));
      REQUIRE(reading.all.events.size() <= bytes.size() / file.word_bytes * file.most_events);
      REQUIRE(reading.header.notes.size() <= 3);
      ++read;
    } catch (const Error&) {
      ++refused;
    }
  }
  CHECK(read > 500);
  CHECK(refused > 20);
}

}  // namespace esi::test

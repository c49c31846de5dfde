// Word by word, from formats.md section 6.
#include <catch2/catch.hpp>

#include "esi/io/prophesee/evt_decoder.hpp"
#include "support/prophesee_file.hpp"
#include "support/random_events.hpp"

namespace esi::test {
namespace {

std::vector<Event> decoded(EvtDecoder& decoder, const std::string& words) {
  std::vector<Event> events;
  decoder.decode(std::as_bytes(std::span(words)), events);
  return events;
}

std::vector<Event> decoded(std::string_view encoding, const std::string& words) {
  EvtDecoder decoder = *EvtDecoder::of(encoding);
  return decoded(decoder, words);
}

/// All x from `first` on whose bit is set.
std::vector<Event> row(std::int64_t t_us, unsigned first, std::uint32_t mask, std::uint16_t y, bool on) {
  std::vector<Event> events;
  for (unsigned i = 0; i < 32; ++i) {
    if ((mask >> i & 1) != 0) events.push_back({t_us, static_cast<std::uint16_t>(first + i), y, on});
  }
  return events;
}

}  // namespace

TEST_CASE("EVT2 words give events, and other words nothing") {
  const std::string words = words32({
      0x8000'0001,                                // time high: 64 us
      0x0000'0000 | 5U << 22 | 639U << 11 | 479,  // off
      0x1000'0000 | 63U << 22 | 2047U << 11 | 0,  // on
      0xA123'4567,
      0xE123'4567,
      0xF123'4567,
      0x2123'4567,
      0x7123'4567,
      0x8FFF'FFFF,  // the last before a wrap
      0x1000'0000 | 1U << 22 | 1U << 11 | 2,
  });
  const std::vector<Event> expected = {
      {69, 639, 479, false}, {127, 2047, 0, true}, {0x3'FFFF'FFC1, 1, 2, true}};
  CHECK(decoded("EVT2", words) == expected);
}

TEST_CASE("EVT2.1 words give a row's events, low half first or, as legacy, high half first") {
  const std::uint64_t word = evt21_word(1, 33, 96, 179, 0x8000'0005);
  const std::vector<std::uint64_t> words = {evt21_time_high(6400),
                                            word,
                                            evt21_word(0, 0, 2016, 2047, 0xFFFF'FFFF),
                                            evt21_word(0xA, 1, 2, 3, 0xFF),
                                            evt21_word(0xE, 1, 2, 3, 0xFF),
                                            evt21_word(0x2, 1, 2, 3, 0xFF),
                                            evt21_word(1, 63, 0, 1, 0)};
  std::vector<Event> expected = row(6433, 96, 0x8000'0005, 179, true);
  const std::vector<Event> full = row(6400, 2016, 0xFFFF'FFFF, 2047, false);
  expected.insert(expected.end(), full.begin(), full.end());
  REQUIRE(expected.size() == 35);
  CHECK(decoded("EVT21", words64(words)) == expected);

  std::vector<std::uint64_t> exchanged;
  for (const std::uint64_t each : words) exchanged.push_back(halves_exchanged(each));
  EvtDecoder legacy = *EvtDecoder::of("EVT21", Evt21Decoder::HalfOrder::high_first);
  CHECK(decoded(legacy, words64(exchanged)) == expected);
  // 8 bytes as they stand in a file: x 96 = 3 * 32, y 179, time low 33, on.
  const std::string bytes("\x05\x00\x00\x80\xb3\x00\x43\x18", 8);
  CHECK(bytes == words64({word}));
}

TEST_CASE("EVT3 words change time, row and column, and some give events") {
  const std::string words = words16({
      0x8002,
      0x6123,                 // 8192 + 0x123 us
      0x0800 | 479,           // row, bit 11 is no part of it
      0x2000 | 0x800 | 1279,  // one ON event
      0x2007,                 // one OFF event
      0x3000 | 0x800 | 100,   // ON vector from 100 on
      0x4801,
      0x5081,
      0x4FFF,  // 12, 8 and 12 wide, one after the other
      0x7000,
      0x1234,
      0x9234,
      0xA101,
      0xB234,
      0xC234,
      0xD234,
      0xE234,
      0xF234,  // skipped
      0x6124,
      0x2005,  // the row stays
      0x8002,
      0x2006,  // a repeated TIME_HIGH changes nothing
      0x8003,
      0x2007,  // a new one starts from 0
  });
  constexpr std::int64_t t_us = 8192 + 0x123;
  std::vector<Event> expected = {{t_us, 1279, 479, true}, {t_us, 7, 479, false}};
  for (const auto& part : {row(t_us, 100, 0x801, 479, true), row(t_us, 112, 0x81, 479, true),
                           row(t_us, 120, 0xFFF, 479, true)}) {
    expected.insert(expected.end(), part.begin(), part.end());
  }
  expected.push_back({t_us + 1, 5, 479, false});
  expected.push_back({t_us + 1, 6, 479, false});
  expected.push_back({3 * 4096, 7, 479, false});
  CHECK(decoded("EVT3", words) == expected);
}

TEST_CASE("EVT times that wrap go on, times that go back a little go back") {
  struct Row {
    const char* encoding;
    unsigned first, second;  // TIME_HIGH
    std::int64_t first_us, second_us;
  };
  const auto row =
      GENERATE(Row{"EVT3", 4095, 0, 4095 << 12, 4096 << 12}, Row{"EVT3", 100, 99, 100 << 12, 99 << 12},
               Row{"EVT3", 2049, 0, 2049 << 12, 4096 << 12}, Row{"EVT3", 2048, 0, 2048 << 12, 0},
               Row{"EVT2", 0xFFF'FFFF, 0, 0x3'FFFF'FFC0, 0x4'0000'0000}, Row{"EVT2", 100, 99, 6400, 6336},
               Row{"EVT21", 0xFFF'FFFF, 1, 0x3'FFFF'FFC0, 0x4'0000'0040}, Row{"EVT21", 100, 99, 6400, 6336});
  CAPTURE(row.encoding, row.first);
  const auto words = [&row](unsigned high) {
    if (std::string_view(row.encoding) == "EVT3") return words16({evt3_word(8, high), 0x2001});
    if (std::string_view(row.encoding) == "EVT2") return words32({evt2_word(8, high), 0x1000'0000});
    return words64({evt21_time_high(std::int64_t{high} * 64), evt21_word(1, 0, 0, 0, 1)});
  };
  const auto events = decoded(row.encoding, words(row.first) + words(row.second));
  REQUIRE(events.size() == 2);
  CHECK(events[0].t_us == row.first_us);
  CHECK(events[1].t_us == row.second_us);
}

TEST_CASE("EVT events before the first time word are counted and left out") {
  const auto [encoding, words] = GENERATE(table<const char*, std::string>(
      {{"EVT2", words32({0x1000'0001, 0x0000'0001, 0x1000'0001, 0x8000'0000, 0x1000'0001})},
       {"EVT21", words64({evt21_word(1, 0, 0, 1, 0x101), evt21_word(0, 0, 0, 1, 1), evt21_time_high(0),
                          evt21_word(1, 0, 0, 1, 1)})},
       {"EVT3", words16({0x6001, 0x2001, 0x4003, 0x8000, 0x0001, 0x2800})}}));
  CAPTURE(encoding);
  EvtDecoder decoder = *EvtDecoder::of(encoding);
  CHECK(decoded(decoder, words) == std::vector<Event>{{0, 0, 1, true}});
  CHECK(decoder.events_without_time() == 3);
}

TEST_CASE("EVT words give the same events whole and in pieces") {
  std::vector<Event> events = random_events({0, 0, 240, 180}, 20000, 30, 5);
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {  // rows of neighbours
    if (i % 5 != 0 && events[i].x < 239) {
      events[i + 1] = events[i];
      ++events[i + 1].x;
    }
  }
  const auto [encoding, words] =
      GENERATE_COPY(table<std::string, std::string>({{"EVT2", words32(evt2_words(events))},
                                                     {"EVT21", words64(evt21_words(events))},
                                                     {"EVT3", words16(evt3_words(events))}}));
  CAPTURE(encoding);
  CHECK(decoded(encoding, words) == events);
  EvtDecoder decoder = *EvtDecoder::of(encoding);
  std::vector<Event> in_pieces;
  const std::size_t piece = decoder.word_bytes() * 3;
  for (std::size_t i = 0; i < words.size(); i += piece) {
    const auto part = decoded(decoder, words.substr(i, piece));
    in_pieces.insert(in_pieces.end(), part.begin(), part.end());
  }
  CHECK(in_pieces == events);
}

TEST_CASE("EVT3 vectors without a new base don't come back on the left") {
  const auto events =
      decoded("EVT3", words16({0x8000, 0x3000}) + words16(std::vector<std::uint16_t>(20000, 0x4FFF)));
  REQUIRE(events.size() == 240000);
  CHECK(events.back().x > 65000);
  CHECK(events[65000].x == 65000);
}

TEST_CASE("other names are no EVT encodings") {
  CHECK_FALSE(EvtDecoder::of("EVT4"));
  CHECK_FALSE(EvtDecoder::of(""));
}

}  // namespace esi::test

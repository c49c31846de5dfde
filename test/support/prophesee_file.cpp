#include "support/prophesee_file.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

namespace esi::test {
namespace {

// Little-endian, as the host is.
template <class Word>
std::string bytes_of(const std::vector<Word>& words) {
  std::string bytes(words.size() * sizeof(Word), '\0');
  if (!words.empty()) std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

/// How many events from the first on differ only in x, which rises and stays below `x_end`.
std::size_t row_length(std::span<const Event> events, unsigned x_end) {
  std::size_t length = 1;
  const Event& first = events[0];
  while (length < events.size()) {
    const Event& event = events[length];
    const bool is_alike = event.t_us == first.t_us && event.y == first.y && event.on == first.on;
    if (!is_alike || event.x <= events[length - 1].x || event.x >= x_end) break;
    ++length;
  }
  return length;
}

std::uint32_t mask_of(std::span<const Event> events, unsigned base_x) {
  std::uint32_t mask = 0;
  for (const Event& event : events) mask |= std::uint32_t{1} << (event.x - base_x);
  return mask;
}

}  // namespace

std::string prophesee_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "% " + line + "\n";
  return text;
}

std::string words16(const std::vector<std::uint16_t>& words) { return bytes_of(words); }
std::string words32(const std::vector<std::uint32_t>& words) { return bytes_of(words); }
std::string words64(const std::vector<std::uint64_t>& words) { return bytes_of(words); }

std::uint16_t evt3_word(unsigned type, unsigned bits) {
  return static_cast<std::uint16_t>(type << 12 | (bits & 0xFFF));
}

std::uint32_t evt2_word(unsigned type, unsigned bits) { return type << 28 | (bits & 0xFFF'FFFF); }

std::uint32_t evt2_event(const Event& event) {
  const auto time_low = static_cast<unsigned>(event.t_us % 64);
  return evt2_word(event.on ? 1 : 0, time_low << 22 | unsigned{event.x} << 11 | event.y);
}

std::uint64_t evt21_word(unsigned type, unsigned time_low, unsigned x, unsigned y, std::uint32_t valid) {
  return std::uint64_t{type} << 60 | std::uint64_t{time_low} << 54 | std::uint64_t{x} << 43 |
         std::uint64_t{y} << 32 | valid;
}

std::uint64_t evt21_time_high(std::int64_t t_us) {
  return std::uint64_t{8} << 60 | (static_cast<std::uint64_t>(t_us) / 64 % (1U << 28)) << 32;
}

std::uint64_t halves_exchanged(std::uint64_t word) { return word << 32 | word >> 32; }

std::uint64_t dat_record(std::uint32_t t_us, unsigned x, unsigned y, bool on) {
  const std::uint32_t address = x | y << 14 | (on ? 1U << 28 : 0);
  return std::uint64_t{address} << 32 | t_us;
}

std::vector<std::uint32_t> evt2_words(std::span<const Event> events) {
  std::vector<std::uint32_t> words;
  std::optional<std::int64_t> time_high;
  for (const Event& event : events) {
    if (time_high != event.t_us / 64) words.push_back(evt2_word(8, static_cast<unsigned>(event.t_us / 64)));
    time_high = event.t_us / 64;
    words.push_back(evt2_event(event));
  }
  return words;
}

std::vector<std::uint64_t> evt21_words(std::span<const Event> events) {
  std::vector<std::uint64_t> words;
  std::optional<std::int64_t> time_high;
  while (!events.empty()) {
    const Event& event = events[0];
    if (time_high != event.t_us / 64) words.push_back(evt21_time_high(event.t_us));
    time_high = event.t_us / 64;
    const unsigned base_x = event.x / 32U * 32U;
    const auto row = events.first(row_length(events, base_x + 32));
    words.push_back(evt21_word(event.on ? 1 : 0, static_cast<unsigned>(event.t_us % 64), base_x, event.y,
                               mask_of(row, base_x)));
    events = events.subspan(row.size());
  }
  return words;
}

std::vector<std::uint16_t> evt3_words(std::span<const Event> events) {
  std::vector<std::uint16_t> words;
  std::optional<std::int64_t> time_high, t_us;
  std::optional<unsigned> y;
  const auto add = [&words](unsigned type, std::int64_t bits) {
    words.push_back(evt3_word(type, static_cast<unsigned>(bits)));
  };
  while (!events.empty()) {
    const Event& event = events[0];
    if (time_high != event.t_us >> 12) add(8, event.t_us >> 12);
    if (t_us != event.t_us) add(6, event.t_us);
    if (y != event.y) add(0, event.y);
    time_high = event.t_us >> 12;
    t_us = event.t_us;
    y = event.y;
    const unsigned polarity = event.on ? 0x800 : 0;
    const auto row = events.first(row_length(events, event.x + 20U));
    if (row.size() == 1) {
      add(2, polarity | event.x);
    } else {
      const std::uint32_t mask = mask_of(row, event.x);
      add(3, polarity | event.x);
      add(4, mask & 0xFFF);
      add(5, mask >> 12);
    }
    events = events.subspan(row.size());
  }
  return words;
}

std::string evt2_recording(std::span<const Event> events) {
  return prophesee_lines({"evt 2.0", "geometry 240x180", "end"}) + words32(evt2_words(events));
}

std::string evt21_recording(std::span<const Event> events) {
  return prophesee_lines({"format EVT21;height=180;width=240", "end"}) + words64(evt21_words(events));
}

std::string evt3_recording(std::span<const Event> events) {
  return prophesee_lines({"evt 3.0", "format EVT3;height=180;width=240", "geometry 240x180", "end"}) +
         words16(evt3_words(events));
}

std::string dat_recording(std::span<const Event> events) {
  std::vector<std::uint64_t> records;
  records.reserve(events.size());
  for (const Event& event : events) {
    records.push_back(dat_record(static_cast<std::uint32_t>(event.t_us), event.x, event.y, event.on));
  }
  return prophesee_lines({"Data file containing CD events.", "Version 2", "Height 180", "Width 240"}) +
         '\x0c' + '\x08' + words64(records);
}

}  // namespace esi::test

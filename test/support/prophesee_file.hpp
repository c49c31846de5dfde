#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "esi/core/event.hpp"

namespace esi::test {

/// The lines, each with "% " in front and a line feed behind.
std::string prophesee_lines(const std::vector<std::string>& lines);

/// Words as they are stored, little-endian.
std::string words16(const std::vector<std::uint16_t>& words);
std::string words32(const std::vector<std::uint32_t>& words);
std::string words64(const std::vector<std::uint64_t>& words);

/// A word of 4 type bits and the low bits of each encoding.
std::uint16_t evt3_word(unsigned type, unsigned bits);
std::uint32_t evt2_word(unsigned type, unsigned bits);
std::uint32_t evt2_event(const Event& event);
std::uint64_t evt21_word(unsigned type, unsigned time_low, unsigned x, unsigned y, std::uint32_t valid);
std::uint64_t evt21_time_high(std::int64_t t_us);

/// A word with its two halves exchanged, as endianness=legacy stores it.
std::uint64_t halves_exchanged(std::uint64_t word);

/// A record of a DAT file.
std::uint64_t dat_record(std::uint32_t t_us, unsigned x, unsigned y, bool on);

/// The words of sorted events; EVT2.1 and EVT3 with vectors where neighbours have one time.
std::vector<std::uint32_t> evt2_words(std::span<const Event> events);
std::vector<std::uint64_t> evt21_words(std::span<const Event> events);
std::vector<std::uint16_t> evt3_words(std::span<const Event> events);

/// Small whole files of a sensor of 240x180 px.
std::string evt2_recording(std::span<const Event> events);
std::string evt21_recording(std::span<const Event> events);
std::string evt3_recording(std::span<const Event> events);
std::string dat_recording(std::span<const Event> events);

}  // namespace esi::test

#include "esi/io/prophesee/evt3_decoder.hpp"

#include <bit>

#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {
namespace {

enum Type : unsigned {  // bits 15..12
  kAddressY = 0x0,
  kAddressX = 0x2,
  kVectorBaseX = 0x3,
  kVector12 = 0x4,
  kVector8 = 0x5,
  kTimeLow = 0x6,
  kTimeHigh = 0x8,
};

constexpr int kTimeLowBits = 12;
// Far outside every sensor, and with the width of a vector still within 16 bits: where many vectors follow
// each other without a new base, which no camera does.
constexpr unsigned kLastBaseX = 0xFFF0;

}  // namespace

inline Event* Evt3Decoder::decode_vector(State& state, unsigned valid, unsigned width, Event* next) {
  const unsigned base_x = state.base_x;
  state.base_x = std::min(base_x + width, kLastBaseX);
  if (state.t_us < 0) {
    state.events_without_time += std::popcount(valid);
    return next;
  }
  for (; valid != 0; valid &= valid - 1) {
    const unsigned x = base_x + static_cast<unsigned>(std::countr_zero(valid));
    *next++ = {state.t_us, static_cast<std::uint16_t>(x), state.y, state.vector_is_on};
  }
  return next;
}

inline Event* Evt3Decoder::decode_word(State& state, unsigned word, Event* next) {
  switch (word >> 12) {
    case kAddressY:
      state.y = word & 0x7FF;
      break;
    case kAddressX:
      if (state.t_us < 0) {
        ++state.events_without_time;
      } else {
        *next++ = {state.t_us, static_cast<std::uint16_t>(word & 0x7FF), state.y, (word & 0x800) != 0};
      }
      break;
    case kVectorBaseX:
      state.base_x = word & 0x7FF;
      state.vector_is_on = (word & 0x800) != 0;
      break;
    case kVector12:
      return decode_vector(state, word & 0xFFF, 12, next);
    case kVector8:
      return decode_vector(state, word & 0xFF, 8, next);
    case kTimeLow:
      if (state.t_us >= 0) state.t_us = (state.t_us >> kTimeLowBits << kTimeLowBits) | (word & 0xFFF);
      break;
    case kTimeHigh: {
      const std::int64_t high_us = state.time_high.unwrap(word & 0xFFF) << kTimeLowBits;
      // It comes before each TIME_LOW or is repeated. The old low part would be up to 4 ms ahead in a new
      // high.
      if (state.t_us < 0 || state.t_us >> kTimeLowBits << kTimeLowBits != high_us) state.t_us = high_us;
      break;
    }
    default:
      break;
  }
  return next;
}

void Evt3Decoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  State state = state_;  // in registers
  append_decoded<std::uint16_t, 12>(
      words, events, [&state](std::uint16_t word, Event* next) { return decode_word(state, word, next); });
  state_ = state;
}

}  // namespace esi

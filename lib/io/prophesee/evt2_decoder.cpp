#include "esi/io/prophesee/evt2_decoder.hpp"

#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {
namespace {

constexpr std::uint32_t kOff = 0x0, kOn = 0x1, kTimeHigh = 0x8;  // bits 31..28
constexpr int kTimeLowBits = 6;

}  // namespace

void Evt2Decoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  State state = state_;  // in registers
  append_decoded<std::uint32_t, 1>(words, events, [&state](std::uint32_t word, Event* next) {
    const std::uint32_t type = word >> 28;
    if (type == kTimeHigh) {
      state.time_high_us = state.time_high.unwrap(word & 0xFFF'FFFF) << kTimeLowBits;
    } else if (type == kOff || type == kOn) {
      if (state.time_high_us < 0) {
        ++state.events_without_time;
      } else {
        *next++ = {state.time_high_us | (word >> 22 & 0x3F), static_cast<std::uint16_t>(word >> 11 & 0x7FF),
                   static_cast<std::uint16_t>(word & 0x7FF), type == kOn};
      }
    }
    return next;
  });
  state_ = state;
}

}  // namespace esi

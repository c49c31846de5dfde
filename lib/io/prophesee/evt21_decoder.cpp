#include "esi/io/prophesee/evt21_decoder.hpp"

#include <bit>

#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {
namespace {

constexpr std::uint64_t kOff = 0x0, kOn = 0x1, kTimeHigh = 0x8;  // bits 63..60
constexpr int kTimeLowBits = 6;
constexpr std::size_t kNeighbours = 32;

}  // namespace

void Evt21Decoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  State state = state_;  // in registers
  const int turn_bits = order_ == HalfOrder::high_first ? 32 : 0;
  append_decoded<std::uint64_t, kNeighbours>(words, events, [&](std::uint64_t stored, Event* next) {
    const std::uint64_t word = std::rotl(stored, turn_bits);
    const std::uint64_t type = word >> 60;
    if (type == kTimeHigh) {
      const auto time_high = static_cast<std::int64_t>(word >> 32 & 0xFFF'FFFF);
      state.time_high_us = state.time_high.unwrap(time_high) << kTimeLowBits;
      return next;
    }
    if (type != kOff && type != kOn) return next;
    auto valid = static_cast<std::uint32_t>(word);
    if (state.time_high_us < 0) {
      state.events_without_time += std::popcount(valid);
      return next;
    }
    const std::int64_t t_us = state.time_high_us | static_cast<std::int64_t>(word >> 54 & 0x3F);
    const auto base_x = static_cast<unsigned>(word >> 43 & 0x7FF);
    const auto y = static_cast<std::uint16_t>(word >> 32 & 0x7FF);
    for (; valid != 0; valid &= valid - 1) {
      const auto x = base_x + static_cast<unsigned>(std::countr_zero(valid));
      *next++ = {t_us, static_cast<std::uint16_t>(x), y, type == kOn};
    }
    return next;
  });
  state_ = state;
}

}  // namespace esi

#include "esi/io/rosbag/message_decoders.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "esi/io/prophesee/word_blocks.hpp"
#include "esi/io/rosbag/message.hpp"

namespace esi {
namespace {

constexpr std::uint64_t kNsPerUs = 1000;
// Far outside every sensor, and with a vector of 8 still within 16 bits.
constexpr unsigned kLastBaseY = 0xFFF0;

/// Rounded half up; `extra_ns` is less than 2^63.
std::int64_t us_from_ns(std::uint64_t ns, std::uint64_t extra_ns = 0) {
  return static_cast<std::int64_t>(ns / kNsPerUs + (ns % kNsPerUs + extra_ns + kNsPerUs / 2) / kNsPerUs);
}

struct DvsWord {
  std::byte bytes[DvsDecoder::kWordBytes];

  template <class Number>
  Number number(std::size_t offset) const {
    Number value;
    std::memcpy(&value, bytes + offset, sizeof value);
    return value;
  }
};

enum LibcaerCmpType : unsigned {  // bits 15..12
  kTimeHigh = 0,
  kTimeLow = 1,
  kAddressX = 2,
  kAddressY = 3,
  kVectorBaseY = 4,
  kVector8 = 5,
};

}  // namespace

void DvsDecoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  append_decoded<DvsWord, 1>(words, events, [](const DvsWord& word, Event* next) {
    const std::int64_t t_us = us_from_ros_time(word.number<std::uint32_t>(4), word.number<std::uint32_t>(8));
    *next++ = {t_us, word.number<std::uint16_t>(0), word.number<std::uint16_t>(2),
               word.bytes[12] != std::byte{0}};
    return next;
  });
}

LibcaerDecoder::LibcaerDecoder(std::uint64_t time_base_ns) : base_us_(us_from_ns(time_base_ns)) {}

void LibcaerDecoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  append_decoded<std::uint64_t, 1>(words, events, [this](std::uint64_t word, Event* next) {
    constexpr std::int64_t kRange_us = std::int64_t{1} << 31;
    const auto is_valid = (word & 1) != 0;
    if (!is_valid) return next;
    const auto time_us = static_cast<std::int64_t>(word >> 32 & 0x7FFF'FFFF);
    if (last_us_ - time_us > kRange_us / 2) base_us_ += kRange_us;
    last_us_ = time_us;
    *next++ = {base_us_ + time_us, static_cast<std::uint16_t>(word >> 17 & 0x7FFF),
               static_cast<std::uint16_t>(word >> 2 & 0x7FFF), (word & 2) != 0};
    return next;
  });
}

LibcaerCmpDecoder::LibcaerCmpDecoder(std::uint64_t time_base_ns) {
  state_.base_us = us_from_ns(time_base_ns);
}

inline Event* LibcaerCmpDecoder::decode_word(State& state, unsigned word, Event* next) {
  constexpr unsigned kLow = 0xFFF;
  const std::int64_t t_us = state.base_us + state.time_us;
  switch (word >> 12) {
    case kTimeHigh:
      state.time_us = (word & kLow) << 12 | (state.time_us & kLow);
      break;
    case kTimeLow:
      state.time_us = (state.time_us & ~kLow) | (word & kLow);
      break;
    case kAddressX:
      state.x = word & 0x7FF;
      break;
    case kAddressY:
      *next++ = {t_us, state.x, static_cast<std::uint16_t>(word & 0x7FF), (word & 0x800) != 0};
      break;
    case kVectorBaseY:
      state.base_y = word & 0x7FF;
      state.vector_is_on = (word & 0x800) != 0;
      break;
    case kVector8:
      for (unsigned valid = word & 0xFF; valid != 0; valid &= valid - 1) {
        const unsigned y = state.base_y + static_cast<unsigned>(std::countr_zero(valid));
        *next++ = {t_us, state.x, static_cast<std::uint16_t>(y), state.vector_is_on};
      }
      state.base_y = std::min(state.base_y + 8, kLastBaseY);
      break;
    default:
      break;
  }
  return next;
}

void LibcaerCmpDecoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  State state = state_;  // in registers
  append_decoded<std::uint16_t, 8>(
      words, events, [&state](std::uint16_t word, Event* next) { return decode_word(state, word, next); });
  state_ = state;
}

void MonoDecoder::decode(std::span<const std::byte> words, std::vector<Event>& events) const {
  append_decoded<std::uint64_t, 1>(words, events, [this](std::uint64_t word, Event* next) {
    *next++ = {us_from_ns(time_base_ns_, word & 0xFFFF'FFFF), static_cast<std::uint16_t>(word >> 32),
               static_cast<std::uint16_t>(word >> 48 & 0x7FFF), word >> 63 != 0};
    return next;
  });
}

}  // namespace esi

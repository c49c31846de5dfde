#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "esi/core/event.hpp"

namespace esi {

/// A record is a 32-bit address and a 32-bit time in us, both big-endian.
inline constexpr std::size_t kAedat2RecordBytes = 8;

inline std::uint32_t aedat2_word(const std::byte* bytes) {
  return std::to_integer<std::uint32_t>(bytes[0]) << 24U | std::to_integer<std::uint32_t>(bytes[1]) << 16U |
         std::to_integer<std::uint32_t>(bytes[2]) << 8U | std::to_integer<std::uint32_t>(bytes[3]);
}

/// The 32-bit clock unwrapped into 64 bits. A time less than 2^31 us (36 min) back is jitter, not a wrap.
class Aedat2Clock {
 public:
  std::int64_t accept(std::uint32_t stored_us) {
    const auto step_us = static_cast<std::int32_t>(stored_us - static_cast<std::uint32_t>(now_us_));
    now_us_ = has_started_ ? now_us_ + step_us : std::int64_t{stored_us};
    has_started_ = true;
    has_wrapped_ |= now_us_ > UINT32_MAX;
    return now_us_;
  }

  bool has_wrapped() const { return has_wrapped_; }

 private:
  std::int64_t now_us_ = 0;
  bool has_started_ = false;
  bool has_wrapped_ = false;
};

/// Whether a DVS128 can have sent all these records.
bool are_dvs128_records(std::span<const std::byte> records);

/// What a DAVIS address says: an event, an external signal, a sample of the IMU, or one reading of a pixel of
/// an intensity frame.
struct DavisAddress {
  static constexpr std::uint32_t kNoEvent = 0x80000000;
  static constexpr std::uint32_t kExternal = 0x400;

  std::uint32_t address;

  /// Neither an external signal nor a word of the IMU or of an intensity frame.
  bool is_event() const { return (address & (kNoEvent | kExternal)) == 0; }
  bool is_reset_read() const { return (address & (kNoEvent | 0xC00)) == kNoEvent; }
  bool is_signal_read() const { return (address & (kNoEvent | 0xC00)) == (kNoEvent | 0x400); }

  /// As jAER counts them: y from the bottom, and x from the right for events, from the left for readings.
  int x() const { return static_cast<int>(address >> 12U & 0x3FF); }
  int y() const { return static_cast<int>(address >> 22U & 0x1FF); }
  bool on() const { return (address & 0x800) != 0; }
  std::uint16_t adc() const { return static_cast<std::uint16_t>(address & 0x3FF); }
};

/// The address of a DVS128. Wider ones are no event of it.
struct Dvs128Address {
  std::uint32_t address;

  bool fits() const { return address <= 0xFFFF; }
  bool is_external() const { return (address & 0x8000) != 0; }
  int x() const { return static_cast<int>(address >> 1U & 0x7F); }  ///< from the right
  int y() const { return static_cast<int>(address >> 8U & 0x7F); }  ///< from the bottom
  bool on() const { return (address & 1) == 0; }
};

}  // namespace esi

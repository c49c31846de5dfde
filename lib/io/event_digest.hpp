#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// What identifies a run of events: counts, sums and the CRC-32 of contract.md, taken over one 13-byte
/// little-endian record per event (int64 t_us from the first event, uint16 x, uint16 y, uint8 on).
class EventDigest {
 public:
  void add(std::span<const Event> events);

  std::int64_t events() const { return events_; }
  std::int64_t on() const { return on_; }
  std::int64_t sum_x() const { return sum_x_; }
  std::int64_t sum_y() const { return sum_y_; }
  int max_x() const { return max_x_; }
  int max_y() const { return max_y_; }
  std::optional<std::int64_t> t_first_us() const { return t_first_us_; }
  std::optional<std::int64_t> t_last_us() const { return t_last_us_; }
  std::int64_t duration_us() const { return t_first_us_ ? *t_last_us_ - *t_first_us_ : 0; }

  /// 8 lower-case hex digits.
  std::string crc32() const;

 private:
  std::int64_t events_ = 0, on_ = 0, sum_x_ = 0, sum_y_ = 0;
  int max_x_ = 0, max_y_ = 0;
  std::optional<std::int64_t> t_first_us_, t_last_us_;
  std::uint32_t crc_ = 0;
  std::vector<unsigned char> records_;  ///< reused
};

/// CRC-32 of any bytes, 8 lower-case hex digits.
std::string crc32_of(std::string_view bytes);

}  // namespace esi

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/prophesee/wrapping_time.hpp"

namespace esi {

/// Prophesee's EVT2.1: words of 64 bits, each with the events of up to 32 neighbours in a row, or with the
/// high bits of the time. See formats.md section 6. What a word leaves for later ones is kept from call to
/// call.
class Evt21Decoder {
 public:
  static constexpr std::size_t kWordBytes = 8;

  /// The order of a word's two halves: "legacy" has the upper one first.
  enum class HalfOrder { low_first, high_first };

  explicit Evt21Decoder(HalfOrder order) : order_(order) {}

  /// Appends the events of whole words. Other words than events and times are skipped.
  void decode(std::span<const std::byte> words, std::vector<Event>& events);

  /// Events before the first time word: they have no time and are left out.
  std::int64_t events_without_time() const { return state_.events_without_time; }

 private:
  struct State {
    WrappingTime<28> time_high;  ///< in units of 64 us
    std::int64_t time_high_us = -1;
    std::int64_t events_without_time = 0;
  };

  HalfOrder order_;
  State state_;
};

}  // namespace esi

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/prophesee/wrapping_time.hpp"

namespace esi {

/// Prophesee's EVT2: words of 32 bits, each with one event or with the high bits of the time. See formats.md
/// section 6. What a word leaves for later ones is kept from call to call.
class Evt2Decoder {
 public:
  static constexpr std::size_t kWordBytes = 4;

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

  State state_;
};

}  // namespace esi

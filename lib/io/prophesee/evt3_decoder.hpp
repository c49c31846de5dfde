#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/prophesee/wrapping_time.hpp"

namespace esi {

/// Prophesee's EVT3: words of 16 bits that change the time, the row or the column, some of which make events.
/// See formats.md section 6. What a word leaves for later ones is kept from call to call.
class Evt3Decoder {
 public:
  static constexpr std::size_t kWordBytes = 2;

  /// Appends the events of whole words. Triggers, continued and unknown words are skipped.
  void decode(std::span<const std::byte> words, std::vector<Event>& events);

  /// Events before the first high part of the time: they have no time and are left out.
  std::int64_t events_without_time() const { return state_.events_without_time; }

 private:
  struct State {
    std::int64_t t_us = -1;
    WrappingTime<12> time_high;  ///< in units of 4096 us
    unsigned base_x = 0;         ///< of the next vector
    std::uint16_t y = 0;
    bool vector_is_on = false;
    std::int64_t events_without_time = 0;
  };

  static Event* decode_word(State& state, unsigned word, Event* next);
  static Event* decode_vector(State& state, unsigned valid, unsigned width, Event* next);

  State state_;
};

}  // namespace esi

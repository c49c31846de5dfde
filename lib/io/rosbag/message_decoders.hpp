#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

// Encodings of events in ROS messages, beside Prophesee's own. See formats.md sections 8.1 to 8.3. A decoder
// is for one message; it appends the events of whole words, and keeps its state from call to call.

/// dvs_msgs/EventArray: uint16 x, uint16 y, uint32 seconds, uint32 nanoseconds, uint8 polarity.
class DvsDecoder {
 public:
  static constexpr std::size_t kWordBytes = 13;
  void decode(std::span<const std::byte> words, std::vector<Event>& events);
};

/// libcaer: its 8-byte polarity events, times from `time_base_ns` on.
class LibcaerDecoder {
 public:
  static constexpr std::size_t kWordBytes = 8;
  explicit LibcaerDecoder(std::uint64_t time_base_ns);
  void decode(std::span<const std::byte> words, std::vector<Event>& events);

 private:
  std::int64_t base_us_;
  std::int64_t last_us_ = -1;  ///< as stored
};

/// libcaer_cmp: words of 16 bits, vectors along y.
class LibcaerCmpDecoder {
 public:
  static constexpr std::size_t kWordBytes = 2;
  explicit LibcaerCmpDecoder(std::uint64_t time_base_ns);
  void decode(std::span<const std::byte> words, std::vector<Event>& events);

 private:
  struct State {
    std::int64_t base_us = 0;
    unsigned time_us = 0;  ///< from base_us on
    std::uint16_t x = 0;
    unsigned base_y = 0;  ///< of the next vector
    bool vector_is_on = false;
  };

  static Event* decode_word(State& state, unsigned word, Event* next);

  State state_;
};

/// mono: words of 64 bits with x, y, polarity and nanoseconds from `time_base_ns` on.
class MonoDecoder {
 public:
  static constexpr std::size_t kWordBytes = 8;
  explicit MonoDecoder(std::uint64_t time_base_ns) : time_base_ns_(time_base_ns) {}
  void decode(std::span<const std::byte> words, std::vector<Event>& events) const;

 private:
  std::uint64_t time_base_ns_;
};

}  // namespace esi

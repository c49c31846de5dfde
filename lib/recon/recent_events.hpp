#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/time.hpp"

namespace esi {

/// An event with its polarity and weight as one number: + for ON.
struct SignedEvent {
  std::int64_t t_us;
  std::uint16_t x;
  std::uint16_t y;
  float p;
};
static_assert(sizeof(SignedEvent) == 16);

/// The events of the last few seconds, for when an intensity frame that ends now tells when it began.
class RecentEvents {
 public:
  explicit RecentEvents(std::int64_t span_us) : span_us_(span_us) {}

  /// Events that follow those of earlier calls. `weights`: one a piece or none.
  void add(std::span<const Event> events, std::span<const float> weights);

  /// The events kept, those of the last span_us at least.
  std::span<const SignedEvent> all() const { return std::span(events_).subspan(first_); }
  /// Those inside an interval.
  std::span<const SignedEvent> within(Interval interval) const;

 private:
  void drop_old();

  std::int64_t span_us_;
  std::vector<SignedEvent> events_;
  std::size_t first_ = 0;  ///< those before are too old
};

}  // namespace esi

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "esi/recon/esi.hpp"

// The event loop of ESI as a template, for Esi itself and for methods that weigh events as they go.

namespace esi {

struct EachCountsOne {
  float operator()(std::uint32_t /*pixel*/, bool /*on*/) const { return 1.0F; }
  void prefetch(std::uint32_t /*pixel*/) const {}
};

/// One weight after the other.
struct GivenWeights {
  const float* next;
  float operator()(std::uint32_t /*pixel*/, bool /*on*/) { return *next++; }
  void prefetch(std::uint32_t /*pixel*/) const {}
};

/// E <- clamp(gamma(dt) E + c p), with everything the loop needs at hand.
class EsiIntegrator {
 public:
  /// Times of events lie within 0..kEpochSpan_us after the epoch, those of pixels within +-kEpochSpan_us, so
  /// that differences fit in 31 bits. Longer than the longest support.
  static constexpr std::int32_t kEpochSpan_us = (1 << 30) - 1;

  EsiIntegrator(const EsiOptions& options, SensorSize size, std::int64_t epoch_us)
      : c_{-static_cast<float>(options.c_off), static_cast<float>(options.c_on)},
        e_min_(static_cast<float>(options.e_min)),
        e_max_(static_cast<float>(options.e_max)),
        width_px_(static_cast<std::uint32_t>(size.width_px)),
        epoch_us_(epoch_us) {}

  /// No branches: the polarity selects from a table, the clamp is a maximum and a minimum.
  /// `weight_of(pixel, on)` is asked once for each event, in order.
  template <class Loss, class Weight>
  void add(std::span<const Event> events, Weight& weight_of, const Loss& loss, EsiPixel* pixels) const {
    const EsiIntegrator self = *this;  // locals, so that stores to pixels can't change them
    Weight weight = weight_of;
    const auto index_of = [&self](const Event& event) { return event.y * self.width_px_ + event.x; };
    const auto take = [&](const Event& event) {
      const std::uint32_t index = index_of(event);
      EsiPixel& pixel = pixels[index];
      const auto t_us = static_cast<std::int32_t>(event.t_us - self.epoch_us_);
      const float e =
          pixel.e - pixel.e * loss(t_us - pixel.t_us) + self.c_[event.on] * weight(index, event.on);
      pixel = {std::min(std::max(e, self.e_min_), self.e_max_), t_us};
    };
    const std::size_t fetched = events.size() - std::min(kPrefetchEvents, events.size());
    for (std::size_t i = 0; i < fetched; ++i) {
      const std::uint32_t ahead = index_of(events[i + kPrefetchEvents]);
      __builtin_prefetch(pixels + ahead, 1);
      weight.prefetch(ahead);
      take(events[i]);
    }
    for (std::size_t i = fetched; i < events.size(); ++i) take(events[i]);
    weight_of = weight;
  }

 private:
  /// Pixels are fetched this many events ahead: early enough for the L3 cache, late enough to stay in L1.
  static constexpr std::size_t kPrefetchEvents = 16;

  std::array<float, 2> c_;  ///< what an OFF and an ON event add
  float e_min_;
  float e_max_;
  std::uint32_t width_px_;
  std::int64_t epoch_us_;
};

template <class Weight>
Weight Esi::accumulate(std::span<const Event> events, Weight weight_of) {
  if (events.empty()) return weight_of;
  begin_at(events.front().t_us);
  t_last_us_ = events.back().t_us;
  while (true) {
    const std::size_t near = events_near_epoch(events);
    const EsiIntegrator integrator(options_, size_, epoch_us_);
    std::visit([&](const auto& loss) { integrator.add(events.first(near), weight_of, loss, pixels_.data()); },
               loss_);
    if (near == events.size()) return weight_of;
    events = events.subspan(near);
    // At this event, whichever call brings it: how events are cut into calls leaves no trace.
    take_epoch(events.front().t_us);
  }
}

}  // namespace esi

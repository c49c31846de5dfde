#include "esi/recon/esi_adaptive.hpp"

#include <algorithm>

#include "esi/recon/esi_integrator.hpp"

namespace esi {
namespace {

/// Events are filtered in pieces that stay in the L1 cache.
constexpr std::size_t kPieceEvents = 1024;

struct GivenAndBalance {
  GivenWeights given;
  PolarityBalance::Kernel balance;
  float operator()(std::uint32_t pixel, bool on) { return given(pixel, on) * balance(pixel, on); }
  void prefetch(std::uint32_t pixel) const { balance.prefetch(pixel); }
};

}  // namespace

void EsiAdaptiveOptions::declare(OptionTable& table) {
  esi.declare(table);
  balance.declare(table);
  EventFilterOptions::declare_background(table, background_us);
  smoothing.declare(table);
}

EsiAdaptive::EsiAdaptive(const EsiAdaptiveOptions& options, SensorSize size)
    : esi_(options.esi, size), smoothing_(options.smoothing) {
  if (options.background_us > 0) background_.emplace(options.background_us, size);
  if (options.balance.balance) balance_.emplace(options.balance, size);
}

void EsiAdaptive::take(std::span<const Event> events, std::span<const float> weights) {
  if (!background_) return integrate(events, weights);
  while (!events.empty()) {
    const auto piece = events.first(std::min(kPieceEvents, events.size()));
    const auto piece_weights = weights.first(std::min(piece.size(), weights.size()));
    kept_.assign(piece.begin(), piece.end());
    kept_weights_.assign(piece_weights.begin(), piece_weights.end());
    remove_unkept(*background_, kept_, kept_weights_);
    integrate(kept_, kept_weights_);
    events = events.subspan(piece.size());
    weights = weights.subspan(piece_weights.size());
  }
}

void EsiAdaptive::integrate(std::span<const Event> events, std::span<const float> weights) {
  if (!balance_) return esi_.process(events, weights);
  while (!events.empty()) {
    const auto part = events.first(std::min(events.size(), balance_->until_update()));
    if (weights.empty()) {
      balance_->take_back(esi_.accumulate(part, balance_->kernel()), part.size());
    } else {
      const GivenAndBalance both{{weights.data()}, balance_->kernel()};
      balance_->take_back(esi_.accumulate(part, both).balance, part.size());
      weights = weights.subspan(part.size());
    }
    events = events.subspan(part.size());
  }
}

void EsiAdaptive::render_levels(std::int64_t t_us, cv::Mat1f& levels) {
  esi_.render_levels(t_us, levels);
  smoothing_.apply(levels);
}

}  // namespace esi

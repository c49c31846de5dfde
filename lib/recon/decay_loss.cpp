#include "esi/recon/decay_loss.hpp"

#include <array>
#include <cmath>

namespace esi {
namespace {

/// Smaller losses leave a float as it is; left out of the table they also bring no denormals into the loop.
constexpr double kLeastLoss = 0x1p-26;
/// Where an exponential leaves less than this, 1 - gamma rounds to 1.
constexpr double kLeastGamma = 1e-8;
/// Times in the event loop have 31 bits.
constexpr double kLongestTime_us = 0x1p31 - 1.0;

/// The first whole microsecond from which the table is constant.
double memory_us(const DecayOptions& options) {
  const double rate_hz = options.decay == Decay::none ? 0.0 : options.alpha_hz;
  const double exponential_us = rate_hz > 0.0 ? -std::log(kLeastGamma) / rate_hz * 1e6 : kLongestTime_us;
  return std::min(std::ceil(std::min(support_us(options), exponential_us)), kLongestTime_us);
}

}  // namespace

std::optional<CubicLoss> CubicLoss::of(const DecayOptions& options) {
  if (options.decay == Decay::none) return CubicLoss{};
  const bool is_cubic = options.alpha_hz == 0.0 && (options.n == 1.0 || options.n == 2.0 || options.n == 3.0);
  if (!is_cubic || std::isinf(support_us(options))) return std::nullopt;

  constexpr std::array<std::array<float, 3>, 3> kPolynomial{{{1, 0, 0}, {2, -1, 0}, {3, -3, 1}}};
  constexpr std::array<std::array<float, 3>, 3> kPower{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto row = static_cast<std::size_t>(options.n) - 1;
  const auto& k = options.decay == Decay::power ? kPower[row] : kPolynomial[row];

  CubicLoss loss;
  loss.k1_ = k[0];
  loss.k2_ = k[1];
  loss.k3_ = k[2];
  loss.per_us_ = static_cast<float>(1.0 / support_us(options));
  // Rounding must not leave u below 1 at the end of the support.
  const auto end_us = static_cast<float>(std::ceil(support_us(options)));
  while (end_us * loss.per_us_ < 1.0F) loss.per_us_ = std::nextafter(loss.per_us_, 1.0F);
  return loss;
}

TableLoss::TableLoss(const DecayOptions& options) : end_(static_cast<float>(memory_us(options) + 1.0)) {
  const std::size_t last = (std::bit_cast<std::uint32_t>(end_) >> kCellBits) - kFirst;
  cells_.resize(last + 1);  // the first one holds dt = 0 alone, with loss 0
  for (std::size_t i = 1; i < last; ++i) cells_[i] = line(options, left_edge(i), left_edge(i + 1));
  // The last line ends at end_, there exactly (a + end b == 1 also in floats).
  cells_[last] = line(options, left_edge(last), end_);
  cells_[last].a = static_cast<float>(decay_loss(options, memory_us(options))) - end_ * cells_[last].b;
}

float TableLoss::left_edge(std::size_t i) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(kFirst + i) << kCellBits);
}

/// The line that deviates equally at the edges and, to the other side, in the middle.
TableLoss::Cell TableLoss::line(const DecayOptions& options, double left, double right) {
  const double loss_left = decay_loss(options, left - 1.0);
  const double loss_right = decay_loss(options, right - 1.0);
  if (loss_right < kLeastLoss || right <= left) return {};
  const double slope = (loss_right - loss_left) / (right - left);
  const double sag = (loss_left + loss_right) / 2.0 - decay_loss(options, (left + right) / 2.0 - 1.0);
  return {.a = static_cast<float>(loss_left - left * slope - sag / 2.0), .b = static_cast<float>(slope)};
}

DecayLoss loss_of(const DecayOptions& options) {
  if (const auto cubic = CubicLoss::of(options)) return *cubic;
  return TableLoss(options);
}

}  // namespace esi

#include "esi/recon/esi.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "esi/core/error.hpp"
#include "esi/recon/esi_integrator.hpp"

namespace esi {
namespace {

/// A narrower range of E would make grey levels of rounding errors.
constexpr double kLeastRange = 0.001;

/// I = 255 (E - e_min) / (e_max - e_min)
struct Readout {
  float scale;
  float offset;

  explicit Readout(const EsiOptions& options)
      : scale(static_cast<float>(255.0 / (options.e_max - options.e_min))),
        offset(static_cast<float>(-255.0 * options.e_min / (options.e_max - options.e_min))) {}

  float level_of(float e) const { return e * scale + offset; }
  std::uint8_t grey_of(float e) const {
    return static_cast<std::uint8_t>(static_cast<std::int32_t>(e * scale + (offset + 0.5F)));
  }
};

std::vector<EsiPixel> pixels_of(SensorSize size) {
  const auto count = static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px);
  try {
    return std::vector<EsiPixel>(count);
  } catch (const std::bad_alloc&) {
    throw Error(fmt::format("esi: a sensor of {} px needs {:.1f} GB of memory, more than there is",
                            to_string(size), static_cast<double>(count * sizeof(EsiPixel)) * 1e-9));
  }
}

}  // namespace

void EsiOptions::declare(OptionTable& table) {
  decay.declare(table);
  table.real("c_on", c_on, {0.001, 1000.0}, "", "what an ON event adds to E");
  table.real("c_off", c_off, {0.001, 1000.0}, "", "what an OFF event takes from E");
  table.real("e_min", e_min, {-1e6, 1e6}, "", "lower bound of E, shown black");
  table.real("e_max", e_max, {-1e6, 1e6}, "", "upper bound of E, shown white");
  table.toggle("readout_decay", readout_decay, "fade E to the frame's time before it is shown");
}

void EsiOptions::check() const {
  if (e_max - e_min >= kLeastRange && e_min <= 0.0 && e_max >= 0.0) return;
  throw usage_error(fmt::format("e_min {} and e_max {}: write e_min <= 0 <= e_max, at least {} apart", e_min,
                                e_max, kLeastRange));
}

Esi::Esi(const EsiOptions& options, SensorSize size)
    : options_(options), size_(size), loss_(loss_of(options.decay)), pixels_(pixels_of(size)) {
  options_.check();
}

void Esi::take(std::span<const Event> events, std::span<const float> weights) {
  if (weights.empty()) {
    accumulate(events, EachCountsOne{});
  } else {
    accumulate(events, GivenWeights{weights.data()});
  }
}

void Esi::begin_at(std::int64_t t_us) {
  if (!has_events_) epoch_us_ = t_us;
  has_events_ = true;
}

std::size_t Esi::events_near_epoch(std::span<const Event> events) const {
  const auto is_near = [this](const Event& event) {
    return event.t_us - epoch_us_ <= EsiIntegrator::kEpochSpan_us;
  };
  return static_cast<std::size_t>(std::partition_point(events.begin(), events.end(), is_near) -
                                  events.begin());
}

void Esi::take_epoch(std::int64_t epoch_us) {
  move_epoch(epoch_us - epoch_us_, pixels_);
  epoch_us_ = epoch_us;
}

void Esi::move_epoch(std::int64_t by_us, std::span<EsiPixel> pixels) const {
  // Only a slow exponential has a memory longer than EsiIntegrator::kEpochSpan_us, and can be applied in
  // parts.
  const bool is_longer =
      std::visit([](const auto& loss) { return loss(EsiIntegrator::kEpochSpan_us); }, loss_) < 1.0F;
  for (EsiPixel& pixel : pixels) {
    const std::int64_t t_us = std::max<std::int64_t>(pixel.t_us - by_us, -EsiIntegrator::kEpochSpan_us);
    const auto left_out_us = static_cast<double>(t_us - (pixel.t_us - by_us));
    if (is_longer) pixel.e = static_cast<float>(pixel.e * gamma(options_.decay, left_out_us));
    pixel.t_us = static_cast<std::int32_t>(t_us);
  }
}

void Esi::render(std::int64_t t_us, cv::Mat1b& grey) {
  show(t_us, grey, [readout = Readout(options_)](float e) { return readout.grey_of(e); });
}

void Esi::render_levels(std::int64_t t_us, cv::Mat1f& levels) {
  show(t_us, levels, [readout = Readout(options_)](float e) { return readout.level_of(e); });
}

template <class Image, class Shade>
void Esi::show(std::int64_t t_us, Image& image, Shade shade) const {
  image.create(size_.height_px, size_.width_px);
  if (options_.readout_decay) return show_decayed(std::max(t_us, t_last_us_) - epoch_us_, image, shade);
  for (int y = 0; y < image.rows; ++y) {
    const std::span<const EsiPixel> pixels = row(pixels_, y);
    auto* const shown = image[y];
    for (std::size_t x = 0; x < pixels.size(); ++x) shown[x] = shade(pixels[x].e);
  }
}

template <class Image, class Shade>
void Esi::show_decayed(std::int64_t since_epoch_us, Image& image, Shade shade) const {
  std::span<const EsiPixel> state = pixels_;
  std::vector<EsiPixel> moved;
  if (since_epoch_us > EsiIntegrator::kEpochSpan_us) {
    moved = pixels_;
    move_epoch(since_epoch_us, moved);
    state = moved;
    since_epoch_us = 0;
  }
  const auto t_us = static_cast<std::int32_t>(since_epoch_us);
  const auto show_row = [&](std::span<const EsiPixel> pixels, const auto& loss, auto* shown) {
    for (std::size_t x = 0; x < pixels.size(); ++x) {
      shown[x] = shade(pixels[x].e - pixels[x].e * loss(t_us - pixels[x].t_us));
    }
  };
  const auto show_rows = [&](const auto& loss) {
    for (int y = 0; y < image.rows; ++y) show_row(row(state, y), loss, image[y]);
  };
  std::visit(show_rows, loss_);
}

std::span<const EsiPixel> Esi::row(std::span<const EsiPixel> pixels, int y) const {
  const auto width = static_cast<std::size_t>(size_.width_px);
  return pixels.subspan(static_cast<std::size_t>(y) * width, width);
}

}  // namespace esi

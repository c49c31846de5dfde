#include "esi/io/aedat2/frame_assembler.hpp"

#include <algorithm>
#include <cstdlib>

namespace esi {
namespace {

/// 10 bits spread over 16: 1023 becomes 65535.
std::uint16_t full_range(int value) {
  const int ten_bits = std::clamp(value, 0, 1023);
  return static_cast<std::uint16_t>(ten_bits << 6 | ten_bits >> 4);
}

}  // namespace

std::optional<IntensityFrame> Aedat2FrameAssembler::add(DavisAddress reading, std::int64_t t_us) {
  if (!sensor_.contains(reading.x(), reading.y())) return std::nullopt;
  const auto width = static_cast<std::size_t>(sensor_.width_px);
  if (pixels_.empty()) pixels_.resize(width * static_cast<std::size_t>(sensor_.height_px));
  const auto row = static_cast<std::size_t>(sensor_.height_px - 1 - reading.y());
  Pixel& pixel = pixels_[row * width + static_cast<std::size_t>(reading.x())];
  if (reading.is_signal_read()) return add_signal(pixel, reading, t_us);
  if (reading.is_reset_read()) add_reset(pixel, reading, t_us);
  return std::nullopt;
}

void Aedat2FrameAssembler::add_reset(Pixel& pixel, DavisAddress reading, std::int64_t t_us) {
  if (resets_ > 0 && begins_frame(pixel, reading)) discard();
  if (resets_ == 0) first_reset_us_ = t_us;
  last_reset_us_ = t_us;
  last_reset_ = reading;
  pixel.reset = reading.adc();
  pixel.reset_frame = frame_;
  ++resets_;
}

// Pixels are read line by line (columns, on some chips rows), and lines one beside the other from one edge to
// the other, on some chips from the right or from the bottom. Only to the next frame does it jump back.
bool Aedat2FrameAssembler::begins_frame(const Pixel& pixel, DavisAddress reading) const {
  const bool jumps =
      std::abs(reading.x() - last_reset_.x()) > 1 && std::abs(reading.y() - last_reset_.y()) > 1;
  return jumps || pixel.reset_frame == frame_;
}

std::optional<IntensityFrame> Aedat2FrameAssembler::add_signal(Pixel& pixel, DavisAddress reading,
                                                               std::int64_t t_us) {
  if (resets_ == 0 && is_discarded_told_) return std::nullopt;
  if (pixel.reset_frame != frame_ || pixel.signal_frame == frame_) {
    discard();
    return std::nullopt;
  }
  if (signals_ == 0) {
    first_signal_us_ = t_us;
    is_global_shutter_ = resets_ == pixels_.size();
  }
  pixel.signal = reading.adc();
  pixel.signal_frame = frame_;
  ++signals_;
  if (signals_ < pixels_.size()) return std::nullopt;
  is_discarded_told_ = false;
  IntensityFrame frame = complete();
  begin_frame();
  return frame;
}

// With a rolling shutter, columns whose exposure is over are read while others are still being reset.
IntensityFrame Aedat2FrameAssembler::complete() const {
  const std::int64_t begin_us = is_global_shutter_ ? last_reset_us_ : first_reset_us_;
  cv::Mat1w image(sensor_.height_px, sensor_.width_px);
  std::transform(pixels_.begin(), pixels_.end(), image.begin(),
                 [](const Pixel& pixel) { return full_range(pixel.reset - pixel.signal); });
  return {{std::min(begin_us, first_signal_us_), first_signal_us_}, image};
}

void Aedat2FrameAssembler::discard() {
  ++incomplete_;
  is_discarded_told_ = true;
  begin_frame();
}

// What the pixels hold of earlier frames stays, told by their number: no time is lost on it.
void Aedat2FrameAssembler::begin_frame() {
  ++frame_;
  resets_ = 0;
  signals_ = 0;
}

}  // namespace esi

#include "esi/recon/voxel_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace esi {

void fill_voxel_grid(std::span<const Event> events, std::span<const float> weights, int bins, SensorSize size,
                     cv::Mat& grid) {
  const std::array<int, 4> shape{1, bins, size.height_px, size.width_px};
  grid.create(4, shape.data(), CV_32F);
  grid.setTo(0.0F);
  if (events.empty()) return;
  const auto width = static_cast<std::size_t>(size.width_px);
  const std::size_t bin_size = width * static_cast<std::size_t>(size.height_px);
  const std::int64_t first_us = events.front().t_us;
  const auto span_us = static_cast<double>(std::max<std::int64_t>(events.back().t_us - first_us, 1));
  const double bins_per_us = static_cast<double>(bins - 1) / span_us;
  auto* const values = grid.ptr<float>();
  for (std::size_t k = 0; k < events.size(); ++k) {
    const Event& event = events[k];
    const double s = static_cast<double>(event.t_us - first_us) * bins_per_us;
    const auto i = std::min(static_cast<std::size_t>(s), static_cast<std::size_t>(bins - 1));
    const auto d = static_cast<float>(s - static_cast<double>(i));
    const float p = (event.on ? 1.0F : -1.0F) * (weights.empty() ? 1.0F : weights[k]);
    float* const value = values + i * bin_size + event.y * width + event.x;
    value[0] += p * (1.0F - d);
    if (i + 1 < static_cast<std::size_t>(bins)) value[bin_size] += p * d;
  }
}

void normalise_non_zero(cv::Mat& grid) {
  const std::span<float> values(grid.ptr<float>(), grid.total());
  double count = 0.0;
  double sum = 0.0;
  for (const float value : values) {
    count += value != 0.0F ? 1.0 : 0.0;
    sum += static_cast<double>(value);
  }
  if (count == 0.0) return;
  const double mean = sum / count;
  double squares = 0.0;
  for (const float value : values) {
    const double difference = value != 0.0F ? static_cast<double>(value) - mean : 0.0;
    squares += difference * difference;
  }
  const double deviation = std::sqrt(squares / count);
  const double scale = deviation > 0.0 ? 1.0 / deviation : 0.0;
  for (float& value : values) {
    if (value != 0.0F) value = static_cast<float>((static_cast<double>(value) - mean) * scale);
  }
}

}  // namespace esi

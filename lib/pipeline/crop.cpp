#include "esi/pipeline/crop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "esi/core/error.hpp"

namespace esi {
namespace {

// Reads "NUMBER," off the front of `text`.
std::optional<int> take_coordinate(std::string_view& text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto used = static_cast<std::size_t>(stop - text.data());
  if (error != std::errc{} || used >= text.size() || *stop != ',') return std::nullopt;
  if (value < 0 || value >= kMaxSensorSide_px) return std::nullopt;
  text.remove_prefix(used + 1);
  return value;
}

}  // namespace

Region parse_region(std::string_view text) {
  std::string_view rest = text;
  const auto x = take_coordinate(rest);
  const auto y = x ? take_coordinate(rest) : std::nullopt;
  if (!y) throw usage_error(fmt::format("region '{}': write X,Y,WIDTHxHEIGHT, such as 40,20,128x96", text));
  return {*x, *y, parse_sensor_size(rest)};
}

CropSource::CropSource(std::unique_ptr<EventSource> source, Interval interval, std::optional<Region> region)
    : source_(std::move(source)), interval_(interval), region_(region) {
  const auto sensor = source_->sensor_size();
  if (!region_ || !sensor) return;
  const bool fits = region_->x + region_->size.width_px <= sensor->width_px &&
                    region_->y + region_->size.height_px <= sensor->height_px;
  if (!fits) {
    throw usage_error(fmt::format("the region {},{},{} reaches beyond the sensor of {}", region_->x,
                                  region_->y, to_string(region_->size), to_string(*sensor)));
  }
}

std::optional<SensorSize> CropSource::sensor_size() const {
  return region_ ? std::optional(region_->size) : source_->sensor_size();
}

bool CropSource::next(Packet& packet) {
  packet.clear();
  while (!was_cut_ && source_->next(packet)) {
    if (!packet.events.empty()) {
      if (!seen_) seen_ = {packet.events.front().t_us, 0};
      seen_->end_us = packet.events.back().t_us;
    }
    crop_time(packet);
    crop_region(packet);
    if (!packet.events.empty() || !packet.frames.empty()) return true;
  }
  return false;
}

std::optional<double> CropSource::fraction_read() const {
  const std::optional<double> of_all = source_->fraction_read();
  if (was_cut_) return 1.0;
  if (!seen_ || interval_.end_us == Interval{}.end_us || interval_.end_us <= seen_->begin_us) return of_all;
  const auto begin_us = static_cast<double>(seen_->begin_us);
  const double of_time =
      (static_cast<double>(seen_->end_us) - begin_us) / (static_cast<double>(interval_.end_us) - begin_us);
  return std::max(of_all.value_or(0.0), of_time);
}

void CropSource::crop_time(Packet& packet) {
  auto& events = packet.events;
  if (!events.empty() && events.back().t_us >= interval_.end_us) was_cut_ = true;
  const auto position_of = [&events](std::int64_t t_us) {
    return std::partition_point(events.begin(), events.end(),
                                [t_us](const Event& e) { return e.t_us < t_us; });
  };
  events.erase(position_of(interval_.end_us), events.end());
  events.erase(events.begin(), position_of(interval_.begin_us));
  std::erase_if(packet.frames,
                [this](const IntensityFrame& frame) { return !interval_.contains(frame.exposure.end_us); });
  std::erase_if(packet.packet_ends_us, [this](std::int64_t end_us) {
    return end_us <= interval_.begin_us || end_us > interval_.end_us;
  });
}

void CropSource::crop_region(Packet& packet) const {
  if (!region_) return;
  const int x0 = region_->x;
  const int y0 = region_->y;
  std::erase_if(packet.events, [&](const Event& e) { return !region_->size.contains(e.x - x0, e.y - y0); });
  for (Event& event : packet.events) {
    event.x = static_cast<std::uint16_t>(event.x - x0);
    event.y = static_cast<std::uint16_t>(event.y - y0);
  }
  const cv::Rect rect(x0, y0, region_->size.width_px, region_->size.height_px);
  for (IntensityFrame& frame : packet.frames) frame.image = frame.image(rect).clone();
}

}  // namespace esi

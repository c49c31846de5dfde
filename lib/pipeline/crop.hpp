#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "esi/core/time.hpp"
#include "esi/io/event_source.hpp"

namespace esi {

/// A rectangle of pixels.
struct Region {
  int x = 0;
  int y = 0;
  SensorSize size;

  friend bool operator==(const Region&, const Region&) = default;
};

/// Reads "X,Y,WxH". Throws a usage Error that shows the form.
Region parse_region(std::string_view text);

/// The part of a source inside an interval of time and a region, whose corner becomes the origin.
class CropSource final : public EventSource {
 public:
  /// Throws a usage Error when the region reaches beyond the sensor.
  CropSource(std::unique_ptr<EventSource> source, Interval interval, std::optional<Region> region);

  const RecordingHeader& header() const override { return source_->header(); }
  std::optional<SensorSize> sensor_size() const override;
  bool next(Packet& packet) override;
  const Losses& losses() const override { return source_->losses(); }
  std::int64_t time_zero_us() const override { return source_->time_zero_us(); }
  std::optional<std::int64_t> cut_at_us() const override {
    return was_cut_ ? std::optional(interval_.end_us) : std::nullopt;
  }
  /// Where the interval ends, of the time up to there.
  std::optional<double> fraction_read() const override;

 private:
  void crop_time(Packet& packet);
  void crop_region(Packet& packet) const;

  std::unique_ptr<EventSource> source_;
  Interval interval_;
  std::optional<Region> region_;
  bool was_cut_ = false;
  std::optional<Interval> seen_;  ///< from the first event that was read to the last
};

}  // namespace esi

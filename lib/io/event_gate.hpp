#pragma once

#include <memory>
#include <optional>
#include <string>

#include "esi/io/event_source.hpp"

namespace esi {

/// Between a format's reader and everyone else: sorts jitter, leaves out events that go back in time, stray
/// ahead of it or lie outside the sensor, moves times to the clock's zero, and counts what it did
/// (contract.md, "The clock").
class EventGate final : public EventSource {
 public:
  /// `name` is what messages call the recording.
  EventGate(std::unique_ptr<FormatReader> reader, const ReadOptions& options, std::string name);

  const RecordingHeader& header() const override { return reader_->header(); }
  std::optional<SensorSize> sensor_size() const override { return size_; }
  bool next(Packet& packet) override;
  const Losses& losses() const override { return losses_; }
  std::int64_t time_zero_us() const override { return time_zero_us_.value_or(0); }
  std::optional<double> fraction_read() const override { return reader_->fraction_read(); }

 private:
  enum class Order { in_order, jitter, backward };

  void admit(std::size_t first_new);
  void admit_plain(std::vector<Event>::iterator& event, std::vector<Event>::iterator& kept);
  void require_possible(std::int64_t t_us) const;
  bool is_inside(const Event& event);
  bool is_jump(const Event& event) const;
  bool is_stray(std::vector<Event>::const_iterator event) const;
  Order order_of(std::int64_t t_us);
  void settle_time_zero(std::int64_t t_first_us);
  void shift_new(std::size_t first_frame, std::size_t first_packet_end);
  void release(Packet& packet);
  void check_losses() const;

  std::unique_ptr<FormatReader> reader_;
  ReadOptions options_;
  std::string name_;
  std::optional<SensorSize> size_;
  Losses losses_;

  Packet held_;  ///< admitted, but events of the jitter window may still have to go before them
  bool at_end_ = false;
  bool unshifted_ = true;  ///< what is held besides events does not yet stand on the clock
  std::optional<std::int64_t> time_zero_us_;
  std::optional<std::int64_t> newest_us_;  ///< on the clock, as all times from here on
  std::optional<std::int64_t> newest_released_us_;
  std::int64_t admitted_ = 0;
  int max_x_seen_ = 0;
  int max_y_seen_ = 0;
};

}  // namespace esi

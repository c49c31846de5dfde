#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "esi/core/packet.hpp"
#include "esi/io/losses.hpp"

namespace esi {

/// The time that stands for one that int64 does not hold, or that is no number.
inline constexpr std::int64_t kNoTime_us = INT64_MAX;
/// The coordinate that stands for one that is no whole number.
inline constexpr std::int32_t kNoCoordinate = -1;

/// Seconds to whole microseconds, rounded half up; kNoTime_us where that is impossible. The whole seconds go
/// separately: seconds since 1970 have no bits to spare for a product.
std::int64_t us_or_none(double seconds);

/// Rows of an event table as integers, before they are events; reused.
struct EventRows {
  std::vector<std::int64_t> t_us;
  std::vector<std::int32_t> x, y, p;  ///< what 32 bits don't hold is the smallest or largest value

  void resize(std::size_t count);
};

/// Turns rows into events: adds an offset to the times, takes p > 0 as ON, leaves out the coordinates that 16
/// bits don't hold.
class EventRowAppender {
 public:
  /// `name` is the file's, `t_path` and `p_path` the datasets' that messages give. `notes` must outlive this.
  EventRowAppender(std::string name, std::string t_path, std::string p_path, std::vector<std::string>& notes,
                   std::int64_t offset_us = 0);

  /// `first_row` is where the rows begin in the file. Throws an Error for a time that int64 does not hold.
  void append(const EventRows& rows, std::uint64_t first_row, Packet& packet, Losses& losses);

 private:
  void drop_outside(const EventRows& rows, Losses& losses);
  void note_polarity(const EventRows& rows, std::uint64_t first_row);
  [[noreturn]] void refuse_time(const EventRows& rows, std::uint64_t first_row) const;

  std::string name_, t_path_, p_path_;
  std::vector<std::string>* notes_;
  std::int64_t offset_us_;
  bool polarity_is_noted_ = false;
  std::vector<Event> events_;  ///< reused
};

}  // namespace esi

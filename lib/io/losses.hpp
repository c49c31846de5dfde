#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace esi {

/// Why an event of the recording is not used.
enum class Drop {
  outside_sensor,
  backward_time,    ///< more than the jitter window, up to the limit where it is an error
  unreadable_line,  ///< a text line that is no event
  cut_line,         ///< a text file that ends within a line
  time_jump,        ///< alone far ahead of the events around it
  count_
};

/// Damage that is not counted in events.
enum class Damage {
  sorted_jitter,     ///< events put back into order
  corrupt_packet,    ///< packets (chunks, blocks) that could not be decoded
  cut_packet,        ///< the last packet, which the file's end cuts
  unreadable_frame,  ///< intensity frames that are missing or damaged
  missing_table,     ///< no file table (the recorder was killed); nothing is lost by that alone
  count_
};

std::string_view name_of(Drop reason);
std::string_view name_of(Damage reason);

/// What was lost on the way from the file to the events, by reason.
class Losses {
 public:
  void add(Drop reason, std::int64_t events = 1) { dropped_[index(reason)] += events; }
  void add(Damage reason, std::int64_t count = 1) { damaged_[index(reason)] += count; }

  std::int64_t of(Drop reason) const { return dropped_[index(reason)]; }
  std::int64_t of(Damage reason) const { return damaged_[index(reason)]; }
  std::int64_t dropped() const;
  /// Whether anything at all is to be told (exit code 3). A missing file table alone is not damage.
  bool any() const;

  /// "12 events outside_sensor, 1 cut_packet"; empty when there is nothing to tell.
  std::string text() const;

 private:
  template <class Reason>
  static std::size_t index(Reason reason) {
    return static_cast<std::size_t>(reason);
  }

  std::array<std::int64_t, static_cast<std::size_t>(Drop::count_)> dropped_{};
  std::array<std::int64_t, static_cast<std::size_t>(Damage::count_)> damaged_{};
};

}  // namespace esi

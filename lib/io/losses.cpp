#include "esi/io/losses.hpp"

#include <fmt/format.h>

#include <numeric>

namespace esi {

std::string_view name_of(Drop reason) {
  static constexpr std::string_view kNames[] = {"outside_sensor", "backward_time", "unreadable_line",
                                                "cut_line", "time_jump"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::string_view name_of(Damage reason) {
  static constexpr std::string_view kNames[] = {"sorted_jitter", "corrupt_packet", "cut_packet",
                                                "unreadable_frame", "missing_table"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::int64_t Losses::dropped() const {
  return std::accumulate(dropped_.begin(), dropped_.end(), std::int64_t{0});
}

bool Losses::any() const {
  return dropped() > 0 || of(Damage::sorted_jitter) > 0 || of(Damage::corrupt_packet) > 0 ||
         of(Damage::cut_packet) > 0 || of(Damage::unreadable_frame) > 0;
}

std::string Losses::text() const {
  std::string text;
  const auto append = [&text](std::int64_t n, std::string_view what) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, what);
  };
  for (std::size_t i = 0; i < dropped_.size(); ++i) append(dropped_[i], name_of(static_cast<Drop>(i)));
  for (std::size_t i = 0; i < damaged_.size(); ++i) append(damaged_[i], name_of(static_cast<Damage>(i)));
  return text;
}

}  // namespace esi

#include "esi/io/hdf5/event_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Within it, microseconds fit into int64.
constexpr double kMostSeconds = 9.2e12;

bool fits_16_bits(std::int32_t coordinate) { return (coordinate & ~0xFFFF) == 0; }

}  // namespace

std::int64_t us_or_none(double seconds) {
  if (!(std::abs(seconds) < kMostSeconds)) return kNoTime_us;  // NaN, too
  const auto whole = static_cast<std::int64_t>(seconds);
  const double rest = seconds - static_cast<double>(whole);
  return whole * 1'000'000 + static_cast<std::int64_t>(std::floor(rest * 1e6 + 0.5));
}

void EventRows::resize(std::size_t count) {
  t_us.resize(count);
  for (std::vector<std::int32_t>* values : {&x, &y, &p}) values->resize(count);
}

EventRowAppender::EventRowAppender(std::string name, std::string t_path, std::string p_path,
                                   std::vector<std::string>& notes, std::int64_t offset_us)
    : name_(std::move(name)),
      t_path_(std::move(t_path)),
      p_path_(std::move(p_path)),
      notes_(&notes),
      offset_us_(offset_us) {}

// One plain loop; what it meets that is odd is only noticed, and looked for afterwards.
void EventRowAppender::append(const EventRows& rows, std::uint64_t first_row, Packet& packet,
                              Losses& losses) {
  const std::size_t count = rows.t_us.size();
  const std::int32_t* const x = rows.x.data();
  const std::int32_t* const y = rows.y.data();
  const std::int64_t* const t = rows.t_us.data();
  const std::int32_t* const p = rows.p.data();

  events_.resize(count);
  Event* const events = events_.data();
  bool is_time_odd = false;
  std::int32_t coordinate_bits = 0;
  std::int32_t largest_p = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t t_us = 0;
    is_time_odd |= __builtin_add_overflow(t[i], offset_us_, &t_us) || t[i] == kNoTime_us;
    events[i] = {t_us, static_cast<std::uint16_t>(x[i]), static_cast<std::uint16_t>(y[i]), p[i] > 0};
    coordinate_bits |= x[i] | y[i];
    largest_p = std::max(largest_p, p[i]);
  }
  if (is_time_odd) refuse_time(rows, first_row);
  if (largest_p > 1) note_polarity(rows, first_row);
  if (!fits_16_bits(coordinate_bits)) drop_outside(rows, losses);
  packet.events.insert(packet.events.end(), events_.begin(), events_.end());
}

void EventRowAppender::drop_outside(const EventRows& rows, Losses& losses) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (fits_16_bits(rows.x[i] | rows.y[i])) events_[kept++] = events_[i];
  }
  losses.add(Drop::outside_sensor, static_cast<std::int64_t>(events_.size() - kept));
  events_.resize(kept);
}

void EventRowAppender::refuse_time(const EventRows& rows, std::uint64_t first_row) const {
  const auto odd = std::find_if(rows.t_us.begin(), rows.t_us.end(), [this](std::int64_t t_us) {
    std::int64_t sum = 0;
    return t_us == kNoTime_us || __builtin_add_overflow(t_us, offset_us_, &sum);
  });
  throw Error(fmt::format(
      "{}: dataset {}, row {}: the time in microseconds, with the offset {} us added, is no number or does "
      "not fit into 64 bits",
      name_, t_path_, first_row + static_cast<std::uint64_t>(odd - rows.t_us.begin()), offset_us_));
}

void EventRowAppender::note_polarity(const EventRows& rows, std::uint64_t first_row) {
  if (polarity_is_noted_) return;
  const auto odd = std::find_if(rows.p.begin(), rows.p.end(), [](std::int32_t p) { return p > 1; });
  polarity_is_noted_ = true;
  notes_->push_back(
      fmt::format("dataset {}, row {}: polarity {} is none of 0, 1 and -1; every p > 0 is taken as ON",
                  p_path_, first_row + static_cast<std::uint64_t>(odd - rows.p.begin()), *odd));
}

}  // namespace esi

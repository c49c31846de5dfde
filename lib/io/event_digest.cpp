#include "esi/io/event_digest.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace esi {
namespace {

static_assert(std::endian::native == std::endian::little, "records are packed by memcpy");
constexpr std::size_t kRecordBytes = 13;

}  // namespace

void EventDigest::add(std::span<const Event> events) {
  if (events.empty()) return;
  if (!t_first_us_) t_first_us_ = events.front().t_us;
  t_last_us_ = events.back().t_us;
  events_ += static_cast<std::int64_t>(events.size());

  records_.resize(events.size() * kRecordBytes);
  unsigned char* record = records_.data();
  for (const Event& event : events) {
    const std::int64_t t_us = event.t_us - *t_first_us_;
    std::memcpy(record, &t_us, 8);
    std::memcpy(record + 8, &event.x, 2);
    std::memcpy(record + 10, &event.y, 2);
    record[12] = event.on ? 1 : 0;
    record += kRecordBytes;
    on_ += event.on ? 1 : 0;
    sum_x_ += event.x;
    sum_y_ += event.y;
    max_x_ = std::max<int>(max_x_, event.x);
    max_y_ = std::max<int>(max_y_, event.y);
  }
  crc_ = static_cast<std::uint32_t>(crc32_z(crc_, records_.data(), records_.size()));
}

std::string crc32_of(std::string_view bytes) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  return fmt::format("{:08x}", static_cast<std::uint32_t>(crc32_z(0, data, bytes.size())));
}

std::string EventDigest::crc32() const { return fmt::format("{:08x}", crc_); }

}  // namespace esi

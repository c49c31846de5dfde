#include "esi/io/aedat4/events.hpp"

#include <aedat4_generated.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace esi {
namespace {

constexpr std::size_t kRecordBytes = sizeof(aedat4::Event);

// The bytes of a stored event are those of an Event, if only these bits of its second half are 0: the signs
// of x and y, and all but the lowest of polarity.
constexpr std::uint64_t kOddBits = 0x00FE'8000'8000;
static_assert(std::endian::native == std::endian::little && sizeof(Event) == kRecordBytes &&
              offsetof(Event, t_us) == 0 && offsetof(Event, x) == 8 && offsetof(Event, y) == 10 &&
              offsetof(Event, on) == 12);

// By memcpy: FlatBuffers' verifier does not check how a vector of structs is aligned.
aedat4::Event record_at(const std::byte* address) {
  aedat4::Event record;
  std::memcpy(&record, address, kRecordBytes);
  return record;
}

bool are_events(std::span<const std::byte> records) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < records.size(); i += kRecordBytes) {
    std::uint64_t half;
    std::memcpy(&half, records.data() + i + sizeof half, sizeof half);
    bits |= half;
  }
  return (bits & kOddBits) == 0 && reinterpret_cast<std::uintptr_t>(records.data()) % alignof(Event) == 0;
}

}  // namespace

std::optional<Aedat4Events> Aedat4Events::in(std::span<const std::byte> flatbuffer) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(flatbuffer.data());
  flatbuffers::Verifier verifier(data, flatbuffer.size());
  if (!verifier.VerifySizePrefixedBuffer<aedat4::EventPacket>("EVTS")) return std::nullopt;
  const auto* const elements = flatbuffers::GetSizePrefixedRoot<aedat4::EventPacket>(data)->elements();
  Aedat4Events events;
  if (elements != nullptr) {
    events.records_ = std::as_bytes(std::span(elements->Data(), elements->size() * kRecordBytes));
  }
  return events;
}

std::int64_t Aedat4Events::end_us() const {
  const std::int64_t last_us = record_at(&records_.back() + 1 - kRecordBytes).timestamp();
  return last_us == std::numeric_limits<std::int64_t>::max() ? last_us : last_us + 1;
}

// Whole blocks in nearly every packet: it is twice as fast as event by event.
std::size_t Aedat4Events::move_to(std::vector<Event>& events, std::size_t count) {
  count = std::min(count, records_.size() / kRecordBytes);
  const auto records = records_.first(count * kRecordBytes);
  records_ = records_.subspan(records.size());
  if (are_events(records)) {
    const auto* const first = reinterpret_cast<const Event*>(records.data());
    events.insert(events.end(), first, first + count);
    return 0;
  }
  const std::size_t before = events.size();
  for (std::size_t i = 0; i < count; ++i) {
    const aedat4::Event record = record_at(records.data() + i * kRecordBytes);
    if (record.x() < 0 || record.y() < 0) continue;
    events.push_back({record.timestamp(), static_cast<std::uint16_t>(record.x()),
                      static_cast<std::uint16_t>(record.y()), record.polarity()});
  }
  return before + count - events.size();
}

}  // namespace esi

#include "esi/io/aedat3/packets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace esi {
namespace {

constexpr std::size_t kHeadBytes = 28;
constexpr std::int32_t kPolarityBytes = 8;
constexpr std::int32_t kFrameHeadBytes = 36;
// A frame of 640x480 px in four channels has 2.5 MB; no packet of a recorder comes near either.
constexpr std::int64_t kMaxEventBytes = std::int64_t{1} << 26;
constexpr std::int64_t kMaxPacketBytes = std::int64_t{1} << 30;

/// As they are stored, little-endian.
struct Head {
  std::int16_t type, source;
  std::int32_t event_bytes, time_offset, overflow, capacity, events, valid;
};
static_assert(sizeof(Head) == kHeadBytes);

/// Only compressed packets, which RAW files don't have, have a negative type.
bool has_possible_layout(const Head& head) {
  if (head.type == Aedat3Packet::kPolarity) return head.event_bytes == kPolarityBytes;
  if (head.type == Aedat3Packet::kFrame) return head.event_bytes >= kFrameHeadBytes;
  return head.type >= 0;
}

bool is_possible(const Head& head) {
  const bool has_possible_counts =
      head.events >= 0 && head.capacity >= head.events && head.valid >= 0 && head.valid <= head.events;
  if (!has_possible_counts || head.type < 0 || head.overflow < 0 || head.event_bytes < 0) return false;
  if (head.events == 0) return true;
  return head.event_bytes > 0 && head.event_bytes <= kMaxEventBytes &&
         std::int64_t{head.events} * head.event_bytes <= kMaxPacketBytes && has_possible_layout(head);
}

}  // namespace

std::optional<Aedat3Packet> Aedat3Packets::next(Losses& losses, std::vector<std::string>& notes) {
  while (const auto packet = next_head(losses, notes)) {
    if (is_wanted(*packet)) return packet;
    if (bytes_.skip(packet->bytes()) < packet->bytes()) end_within(*packet, losses, notes);
  }
  return std::nullopt;
}

std::span<const std::byte> Aedat3Packets::take_events(const Aedat3Packet& packet, std::size_t at_most,
                                                      Losses& losses, std::vector<std::string>& notes) {
  if (bytes_.peek(packet.event_bytes).size() < packet.event_bytes) {
    end_within(packet, losses, notes);
    return {};
  }
  return bytes_.take(std::min(at_most, bytes_.available() / packet.event_bytes) * packet.event_bytes);
}

std::optional<Aedat3Packet> Aedat3Packets::next_head(Losses& losses, std::vector<std::string>& notes) {
  if (at_end_) return std::nullopt;
  Aedat3Packet packet;
  packet.position = bytes_.position();
  const auto stored = bytes_.take(kHeadBytes);
  if (stored.size() < kHeadBytes) {
    at_end_ = true;
    if (!stored.empty()) end_within(packet, losses, notes);
    return std::nullopt;
  }
  Head head;
  std::memcpy(&head, stored.data(), kHeadBytes);
  if (!is_possible(head)) {
    at_end_ = true;
    losses.add(Damage::corrupt_packet);
    notes.push_back(fmt::format(
        "The packet at byte {} claims {} valid of {} events of {} bytes, type {}, which can't be; reading "
        "stopped there.",
        packet.position, head.valid, head.events, head.event_bytes, head.type));
    return std::nullopt;
  }
  packet.type = head.type;
  packet.source = head.source;
  packet.event_bytes = static_cast<std::size_t>(head.event_bytes);
  packet.events = static_cast<std::size_t>(head.events);
  packet.overflow_us = std::int64_t{head.overflow} << 31;
  return packet;
}

bool Aedat3Packets::is_wanted(const Aedat3Packet& packet) const {
  if (packet.events == 0 || (source_ && packet.source != *source_)) return false;
  return packet.type == Aedat3Packet::kPolarity || packet.type == Aedat3Packet::kFrame;
}

void Aedat3Packets::end_within(const Aedat3Packet& packet, Losses& losses, std::vector<std::string>& notes) {
  at_end_ = true;
  losses.add(Damage::cut_packet);
  notes.push_back(fmt::format("The file ends within the packet at byte {}.", packet.position));
}

}  // namespace esi

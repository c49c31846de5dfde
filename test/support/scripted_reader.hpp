#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "esi/io/event_source.hpp"
#include "esi/io/format_reader.hpp"

namespace esi::test {

/// A reader that plays given packets.
class ScriptedReader final : public FormatReader {
 public:
  explicit ScriptedReader(std::vector<Packet> packets, RecordingHeader header = {})
      : packets_(std::move(packets)), header_(std::move(header)) {}

  const RecordingHeader& header() const override { return header_; }

  bool read(Packet& packet, Losses& /*losses*/) override {
    if (index_ == packets_.size()) return false;
    const Packet& next = packets_[index_++];
    packet.events.insert(packet.events.end(), next.events.begin(), next.events.end());
    packet.frames.insert(packet.frames.end(), next.frames.begin(), next.frames.end());
    packet.packet_ends_us.insert(packet.packet_ends_us.end(), next.packet_ends_us.begin(),
                                 next.packet_ends_us.end());
    return true;
  }

 private:
  std::vector<Packet> packets_;
  RecordingHeader header_;
  std::size_t index_ = 0;
};

/// Events cut into packets of one size.
inline std::vector<Packet> packets_of(const std::vector<Event>& events, std::size_t packet_size) {
  std::vector<Packet> packets;
  for (std::size_t begin = 0; begin < events.size(); begin += packet_size) {
    const std::size_t end = std::min(begin + packet_size, events.size());
    packets.emplace_back().events.assign(events.begin() + static_cast<std::ptrdiff_t>(begin),
                                         events.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return packets;
}

/// Everything a source has, in one packet.
inline Packet drain(EventSource& source) {
  Packet all, packet;
  while (source.next(packet)) {
    all.events.insert(all.events.end(), packet.events.begin(), packet.events.end());
    all.frames.insert(all.frames.end(), packet.frames.begin(), packet.frames.end());
    all.packet_ends_us.insert(all.packet_ends_us.end(), packet.packet_ends_us.begin(),
                              packet.packet_ends_us.end());
  }
  return all;
}

}  // namespace esi::test

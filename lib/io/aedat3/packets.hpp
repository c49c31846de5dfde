#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/io/byte_window.hpp"
#include "esi/io/losses.hpp"

namespace esi {

/// The numbers in front of a packet.
struct Aedat3Packet {
  static constexpr std::int16_t kPolarity = 1;
  static constexpr std::int16_t kFrame = 2;

  std::size_t position = 0;  ///< of its first byte in the file
  std::int16_t type = 0;
  std::int16_t source = 0;
  std::size_t event_bytes = 0;
  std::size_t events = 0;
  std::int64_t overflow_us = 0;  ///< what the upper bits of its times are worth

  std::size_t bytes() const { return events * event_bytes; }
  /// A 31-bit time of one of its events, in full.
  std::int64_t t_us(std::int32_t stored) const { return overflow_us + (stored & 0x7FFF'FFFF); }
};

/// Walks an AEDAT 3.1 file's packets forward. Their events are taken piece by piece.
class Aedat3Packets {
 public:
  /// `source`: packets of others are passed over; empty: of none.
  Aedat3Packets(ByteWindow bytes, std::optional<int> source) : bytes_(std::move(bytes)), source_(source) {}

  /// The next packet of polarity events or frames, whose events must be taken before the next call. Empty at
  /// the end. What is damaged is counted, and told in `notes`.
  std::optional<Aedat3Packet> next(Losses& losses, std::vector<std::string>& notes);

  /// Takes 1 to `at_most` events of the packet, those that are there without waiting; none where the file
  /// ends within it, which is counted and told.
  std::span<const std::byte> take_events(const Aedat3Packet& packet, std::size_t at_most, Losses& losses,
                                         std::vector<std::string>& notes);

  std::optional<double> fraction_taken() const { return bytes_.fraction_taken(); }

 private:
  std::optional<Aedat3Packet> next_head(Losses& losses, std::vector<std::string>& notes);
  bool is_wanted(const Aedat3Packet& packet) const;
  void end_within(const Aedat3Packet& packet, Losses& losses, std::vector<std::string>& notes);

  ByteWindow bytes_;
  std::optional<int> source_;
  bool at_end_ = false;
};

}  // namespace esi

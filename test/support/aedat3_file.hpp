#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"

namespace esi::test {

/// "#!AER-DAT3.1" to "#!END-HEADER"; `sources` are whole lines such as "#Source 1: DAVIS240C\r\n".
std::string aedat3_header(std::string_view sources, std::string_view format = "RAW",
                          std::string_view version = "3.1");

/// The 28 bytes in front of a packet.
struct Aedat3Head {
  std::int16_t type = 1;
  std::int16_t source = 1;
  std::int32_t event_bytes = 8;
  std::int32_t time_offset = 4;
  std::int32_t overflow = 0;
  std::int32_t capacity = 0;
  std::int32_t events = 0;
  std::int32_t valid = 0;
};
std::string aedat3_head(const Aedat3Head& head);

/// A polarity event as it is stored.
std::string aedat3_event(std::int32_t t_us, int x, int y, bool on, bool valid = true);

/// A packet of polarity events, or of others where `type` says so; their time is the lower 31 bits.
std::string aedat3_packet(std::span<const Event> events, std::int16_t source = 1, std::int16_t type = 1);

/// A frame event as it is stored.
struct Aedat3FrameEvent {
  std::uint32_t info = 1U | 1U << 1;  ///< valid, one channel
  std::int32_t start_of_frame = 900, end_of_frame = 1300;
  std::int32_t start_of_exposure = 1000, end_of_exposure = 1200;
  std::int32_t width_px = 0, height_px = 0, x_px = 0, y_px = 0;
  std::vector<std::uint16_t> pixels;
};
/// A packet of one frame.
std::string aedat3_frame_packet(const Aedat3FrameEvent& frame, std::int32_t overflow = 0,
                                std::int16_t source = 1);

/// A recording of a DAVIS240C in several packets: sorted events within 240x180.
std::string aedat3_recording(std::span<const Event> events);

}  // namespace esi::test

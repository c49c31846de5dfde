#include "support/aedat3_file.hpp"

#include <cstring>

namespace esi::test {
namespace {

// Little-endian, as the host is.
template <class Number>
std::string number(Number value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

}  // namespace

std::string aedat3_header(std::string_view sources, std::string_view format, std::string_view version) {
  return std::string("#!AER-DAT")
      .append(version)
      .append("\r\n#Format: ")
      .append(format)
      .append("\r\n")
      .append(sources)
      .append("#Start-Time: 2017-03-01 12:00:00 (TZ+0100)\r\n#!END-HEADER\r\n");
}

std::string aedat3_head(const Aedat3Head& head) {
  return number(head.type) + number(head.source) + number(head.event_bytes) + number(head.time_offset) +
         number(head.overflow) + number(head.capacity) + number(head.events) + number(head.valid);
}

std::string aedat3_event(std::int32_t t_us, int x, int y, bool on, bool valid) {
  const std::uint32_t data = (valid ? 1U : 0U) | (on ? 2U : 0U) | static_cast<std::uint32_t>(y) << 2 |
                             static_cast<std::uint32_t>(x) << 17;
  return number(data) + number(t_us);
}

std::string aedat3_packet(std::span<const Event> events, std::int16_t source, std::int16_t type) {
  Aedat3Head head;
  head.type = type;
  head.source = source;
  head.events = head.valid = head.capacity = static_cast<std::int32_t>(events.size());
  if (!events.empty()) head.overflow = static_cast<std::int32_t>(events.front().t_us >> 31);
  std::string packet = aedat3_head(head);
  for (const Event& event : events) {
    packet += aedat3_event(static_cast<std::int32_t>(event.t_us & 0x7FFFFFFF), event.x, event.y, event.on);
  }
  return packet;
}

std::string aedat3_frame_packet(const Aedat3FrameEvent& frame, std::int32_t overflow, std::int16_t source) {
  std::string event = number(frame.info) + number(frame.start_of_frame) + number(frame.end_of_frame) +
                      number(frame.start_of_exposure) + number(frame.end_of_exposure) +
                      number(frame.width_px) + number(frame.height_px) + number(frame.x_px) +
                      number(frame.y_px);
  for (const std::uint16_t pixel : frame.pixels) event += number(pixel);
  Aedat3Head head;
  head.type = 2;
  head.source = source;
  head.event_bytes = static_cast<std::int32_t>(event.size());
  head.time_offset = 4;
  head.overflow = overflow;
  head.capacity = head.events = head.valid = 1;
  return aedat3_head(head) + event;
}

std::string aedat3_recording(std::span<const Event> events) {
  std::string bytes = aedat3_header("#Source 1: DAVIS240C\r\n");
  while (!events.empty()) {
    // A packet's times share their upper bits.
    std::size_t count = 1;
    while (count < events.size() && count < 4096 && events[count].t_us >> 31 == events[0].t_us >> 31) ++count;
    bytes += aedat3_packet(events.first(count));
    events = events.subspan(count);
  }
  return bytes;
}

}  // namespace esi::test

#include "bad_input/bad_input.hpp"
#include "support/aedat2_file.hpp"
#include "support/aedat3_file.hpp"
#include "support/recordings.hpp"

namespace esi::test {
namespace {

const std::vector<std::string> kNone = {};

/// A DVS128 without a chip in its header, `count` events from `t_us` on, 100 us apart.
std::string dvs128_records(std::uint32_t t_us, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) {
    bytes += aedat2_record(dvs128_address(i % 128, i % 100, i % 2 == 0),
                           t_us + 100 * static_cast<std::uint32_t>(i));
  }
  return bytes;
}

std::function<std::string()> davis(const std::string& between) {
  return [=] {
    const auto events = moving_edge(600);
    std::string bytes = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");
    for (const Event& event : events) {
      if (event.t_us == events[300].t_us) bytes += between;
      bytes +=
          aedat2_record(davis_address(event.x, event.y, event.on), static_cast<std::uint32_t>(event.t_us));
    }
    return bytes;
  };
}

std::string cut(const std::string& bytes, std::size_t by) { return bytes.substr(0, bytes.size() - by); }

std::string aedat3_start() {
  return aedat3_header("#Source 1: DAVIS240C\r\n") + aedat3_packet(moving_edge(100));
}

std::function<std::string()> aedat3_with(const std::string& packet) {
  return [=] { return aedat3_start() + packet; };
}

}  // namespace

BadInputs bad_aedat2() {
  return {"AEDAT 2",
          "recording.aedat",
          {
              {"no magic", 1, "binary", [] { return dvs128_records(0, 200); }},
              {"no chip in the header, addresses of a DVS128", 0, "",
               [] { return aedat2_header("") + dvs128_records(0, 500); }, kNone},
              {"no chip in the header, other addresses", 2, "--chip",
               [] { return aedat2_header("") + aedat2_record(davis_address(200, 100, true), 1); }, kNone},
              {"unknown chip", 2, "--chip",
               [] { return aedat2_header("net.sf.jaer.SomethingElse") + dvs128_records(0, 9); }, kNone},
              {"last record cut", 3, "1 cut_packet", [] { return cut(davis("")(), 3); }, kNone},
              {"32-bit clock wraps", 0, "",
               [] { return aedat2_header("DVS128") + dvs128_records(0xFFFFFF00U, 500); }, kNone},
              {"IMU words among the events", 0, "", [] { return davis(davis_imu_sample(15000))(); }, kNone},
              {"special events among the events", 0, "",
               [] { return davis(aedat2_record(davis_address(5, 5, true) | 1U << 10, 15000))(); }, kNone},
              {"a `#` as first byte of the data", 0, "",
               [] {
                 return aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C") +
                        aedat2_record(davis_address(20, 39, true), 0) +
                        davis("")().substr(aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C").size());
               },
               kNone},
              {"header without events", 1, "no events", [] { return aedat2_header("DVS128"); }, kNone},
          }};
}

BadInputs bad_aedat3() {
  return {
      "AEDAT 3.1",
      "recording.aedat",
      {
          {"header cut", 1, "within its header",
           [] { return aedat3_header("#Source 1: DAVIS240C\r\n").substr(0, 40); }, kNone},
          {"packets compressed", 1, "SerializedTS",
           [] { return aedat3_header("#Source 1: DAVIS240C\r\n", "SerializedTS"); }, kNone},
          {"AEDAT 3.0", 1, "3.0", [] { return aedat3_header("#Source 1: DAVIS240C\r\n", "RAW", "3.0"); },
           kNone},
          {"packet header cut", 3, "1 cut_packet", [] { return cut(aedat3_start() + aedat3_head({}), 5); },
           kNone},
          {"packet cut", 3, "1 cut_packet", [] { return cut(aedat3_start(), 20); }, kNone},
          {"count that overflows", 3, "1 corrupt_packet",
           aedat3_with(aedat3_head(
               {.event_bytes = INT32_MAX, .capacity = INT32_MAX, .events = INT32_MAX, .valid = INT32_MAX})),
           kNone},
          {"negative event size", 3, "1 corrupt_packet",
           aedat3_with(aedat3_head({.event_bytes = -8, .capacity = 1, .events = 1, .valid = 1})), kNone},
          {"more valid events than events", 3, "1 corrupt_packet",
           aedat3_with(aedat3_head({.capacity = 1, .events = 1, .valid = 5}) +
                       aedat3_event(5000, 1, 1, true)),
           kNone},
          {"unknown type of packet", 0, "",
           [] { return aedat3_start() + aedat3_packet(moving_edge(3), 1, 99); }, kNone},
          {"overflow counter of the clock",
           0,
           "",
           aedat3_with(aedat3_head({.overflow = 0, .capacity = 1, .events = 1, .valid = 1}) +
                       aedat3_event(INT32_MAX, 1, 1, true) +
                       aedat3_head({.overflow = 1, .capacity = 1, .events = 1, .valid = 1}) +
                       aedat3_event(0, 2, 1, true)),
           {"--fps", "1"}},
          {"packet without events", 0, "", aedat3_with(aedat3_head({})), kNone},
          {"two cameras", 2, "--stream",
           [] {
             return aedat3_header("#Source 1: DAVIS240C\r\n#Source 2: DVS128\r\n") +
                    aedat3_packet(moving_edge(30), 1) + aedat3_packet(moving_edge(30), 2);
           },
           kNone},
      }};
}

}  // namespace esi::test

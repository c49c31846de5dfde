#include "support/recordings.hpp"

#include <fmt/format.h>

#include "support/aedat2_file.hpp"
#include "support/aedat3_file.hpp"
#include "support/aedat4_file.hpp"
#include "support/hdf5_recordings.hpp"
#include "support/prophesee_file.hpp"
#include "support/rosbag_file.hpp"
#include "support/zip_file.hpp"

namespace esi::test {
namespace {

std::string text_recording(std::span<const Event> events) {
  std::string text;
  for (const Event& event : events) {
    fmt::format_to(std::back_inserter(text), "{}.{:06} {} {} {}\n", event.t_us / 1000000,
                   event.t_us % 1000000, event.x, event.y, event.on ? 1 : 0);
  }
  return text;
}

std::string e2vid_recording(std::span<const Event> events) { return "240 180\n" + text_recording(events); }

std::string zip_recording(std::span<const Event> events) {
  return zip_archive({{"events.txt", e2vid_recording(events)}});
}

std::string metavision_csv_recording(std::span<const Event> events) {
  std::string text = "%geometry:240,180\n";
  for (const Event& event : events) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", event.x, event.y, event.on ? 1 : 0, event.t_us);
  }
  return text;
}

template <Aedat4Compression kCompression>
std::string aedat4_recording(std::span<const Event> events) {
  constexpr std::size_t kPacket = 100;
  Aedat4File file = aedat4_event_file(kCompression, "240x180");
  for (std::size_t begin = 0; begin < events.size(); begin += kPacket) {
    std::vector<Aedat4Event> stored;
    for (const Event& event : events.subspan(begin, std::min(kPacket, events.size() - begin))) {
      stored.push_back({event.t_us, static_cast<std::int16_t>(event.x), static_cast<std::int16_t>(event.y),
                        static_cast<std::uint8_t>(event.on ? 1 : 0)});
    }
    file.add(0, aedat4_event_buffer(stored));
  }
  return file.bytes();
}

constexpr Encoder kEncoders[] = {
    {"aedat4", "aedat4_lz4.aedat4", true, aedat4_recording<Aedat4Compression::lz4>},
    {"aedat4", "aedat4_zstd.aedat4", true, aedat4_recording<Aedat4Compression::zstd>},
    {"aedat4", "aedat4_plain.aedat4", true, aedat4_recording<Aedat4Compression::none>},
    {"aedat3", "aedat3.aedat", true, aedat3_recording},
    {"aedat2", "aedat2.aedat", true, aedat2_recording},
    {"hdf5", "dsec.h5", false, hdf5_recording},
    {"hdf5", "mvsec.hdf5", true, mvsec_recording},
    {"hdf5", "monash.h5", true, monash_recording},
    {"hdf5", "metavision.hdf5", true, metavision_hdf5_recording},
    {"prophesee-raw", "evt2.raw", true, evt2_recording},
    {"prophesee-raw", "evt21.raw", true, evt21_recording},
    {"prophesee-raw", "evt3.raw", true, evt3_recording},
    {"prophesee-dat", "cd.dat", true, dat_recording},
    {"rosbag", "events.bag", true, rosbag_recording},
    {"text", "rpg.txt", false, text_recording},
    {"text", "e2vid.txt", true, e2vid_recording},
    {"zip", "e2vid.zip", true, zip_recording},
    {"text", "metavision.csv", true, metavision_csv_recording},
};

}  // namespace

std::span<const Encoder> encoders() { return kEncoders; }

std::vector<Event> moving_edge(std::int64_t count) {
  constexpr std::int64_t kStep_us = 50;
  std::vector<Event> events;
  for (std::int64_t i = 0; i < count; ++i) {
    events.push_back({i * kStep_us, static_cast<std::uint16_t>((i / 8 + i % 3) % 240),
                      static_cast<std::uint16_t>(i * 37 % 180), i % 5 < 3});
  }
  return events;
}

}  // namespace esi::test

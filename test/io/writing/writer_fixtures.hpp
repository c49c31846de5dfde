#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "esi/io/event_source.hpp"
#include "esi/io/writing/recording_writer.hpp"
#include "io/output/sink_fixtures.hpp"
#include "support/random_events.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

inline constexpr SensorSize kSensor{346, 260};
inline const WriteOptions kWriteOptions{kSensor, 0, "DAVIS346 & <\"co\">"};

struct Content {
  std::vector<Event> events;
  std::vector<IntensityFrame> frames;
};

/// The recording as packets of changing length; some are empty.
inline std::vector<Packet> packets_of(const Content& content, std::size_t longest = 5000) {
  std::mt19937 random(1);
  std::vector<Packet> packets(1);
  std::size_t frame = 0;
  for (std::size_t begin = 0; begin < content.events.size();) {
    const std::size_t end = std::min(begin + random() % (longest + 1), content.events.size());
    Packet& packet = packets.emplace_back();
    packet.events.assign(content.events.begin() + static_cast<std::ptrdiff_t>(begin),
                         content.events.begin() + static_cast<std::ptrdiff_t>(end));
    const bool is_last = end == content.events.size();
    while (frame < content.frames.size() &&
           (is_last || content.frames[frame].exposure.end_us <= content.events[end].t_us)) {
      packet.frames.push_back(content.frames[frame++]);
    }
    begin = end;
  }
  packets.back().frames.insert(packets.back().frames.end(),
                               content.frames.begin() + static_cast<std::ptrdiff_t>(frame),
                               content.frames.end());
  packets.emplace_back();
  return packets;
}

inline void write_recording(const std::filesystem::path& path, const Content& content,
                            const WriteOptions& options = kWriteOptions) {
  const auto writer = open_recording_writer(path, options);
  for (const Packet& packet : packets_of(content)) writer->write(packet);
  writer->finish();
}

/// What this library's reader makes of a file, on the file's own clock.
inline Content read_back(const std::filesystem::path& path) {
  ReadOptions options;
  options.size = to_string(kSensor);
  options.time_zero = TimeZero::file;
  const auto source = open_recording(path, options);
  Content content;
  Packet packet;
  while (source->next(packet)) {
    content.events.insert(content.events.end(), packet.events.begin(), packet.events.end());
    content.frames.insert(content.frames.end(), packet.frames.begin(), packet.frames.end());
  }
  CHECK(source->losses().text().empty());
  if (path.extension() != ".txt") CHECK(source->header().notes.empty());
  return content;
}

inline bool same_frames(const std::vector<IntensityFrame>& a, const std::vector<IntensityFrame>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const IntensityFrame& p, const IntensityFrame& q) {
        return p.exposure == q.exposure && p.image.type() == q.image.type() &&
               p.image.size() == q.image.size() && cv::norm(p.image, q.image, cv::NORM_INF) == 0;
      });
}

/// Frames of noise, 25 a second, exposed for 10 ms from `first_us` on.
inline std::vector<IntensityFrame> noise_frames(std::int64_t first_us, int count) {
  std::vector<IntensityFrame> frames;
  for (int i = 0; i < count; ++i) {
    const std::int64_t begin_us = first_us + i * 40000;
    frames.push_back({{begin_us, begin_us + 10001}, noise(i, kSensor.width_px, kSensor.height_px)});
  }
  return frames;
}

}  // namespace esi::test

#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bench/timing.hpp"
#include "esi/core/packet.hpp"
#include "support/shared_data.hpp"

namespace esi::bench {

struct Stream {
  std::string name;
  SensorSize size;
  std::vector<Event> events;
};

inline Stream tag_board(const std::filesystem::path& csv) {
  Stream stream{"tag board", {346, 260}, {}};
  std::ifstream file(csv);
  std::string line;
  std::getline(file, line);  // t,x,y,p
  char comma = ',';
  int on = 0;
  for (Event e{}; file >> e.t_us >> comma >> e.x >> comma >> e.y >> comma >> on;) {
    e.on = on == 1;
    stream.events.push_back(e);
  }
  return stream;
}

/// 12 Mev/s from an upright edge that crosses the sensor in 0.1 s, spread over 24 columns.
inline Stream moving_edge(SensorSize size) {
  Stream stream{"synthetic edge", size, {}};
  std::mt19937 generator(1);
  const auto random = [&generator] { return static_cast<unsigned>(generator()); };
  const auto width = static_cast<unsigned>(size.width_px);
  for (unsigned i = 0; i < 1'500'000; ++i) {
    const unsigned t_us = i / 12;
    const unsigned x = (t_us * width / 100'000 + random() % 24) % width;
    const unsigned y = random() % static_cast<unsigned>(size.height_px);
    stream.events.push_back(
        {t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), (random() & 1) != 0});
  }
  return stream;
}

/// As in a pipeline: packets come one after another in the same buffer. Copying into it isn't timed.
template <class Target>
double seconds_for(const Stream& stream, Target& target) {
  std::vector<Event> packet(kPacketEvents);
  double sum_s = 0.0;
  for (std::size_t i = 0; i < stream.events.size(); i += packet.size()) {
    const std::size_t count = std::min(packet.size(), stream.events.size() - i);
    std::copy_n(stream.events.begin() + static_cast<std::ptrdiff_t>(i), count, packet.begin());
    sum_s += seconds([&] { target.process(std::span(packet).first(count)); });
  }
  return sum_s;
}

/// The tag board (else an edge of its size), and an edge on a large sensor.
inline std::vector<Stream> streams() {
  const auto csv = test::shared_data("tagboard/tagboard.txyp_us.csv");
  return {csv ? tag_board(*csv) : moving_edge({346, 260}), moving_edge({1280, 720})};
}

}  // namespace esi::bench

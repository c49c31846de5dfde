// How fast ESI takes events and makes frames, beside what the memory traffic alone costs, measured in the
// same run, round by round. Ratios carry over to other machines and hours; Mev/s don't.
//   build/release/bin/bench_recon

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bench/timing.hpp"
#include "esi/core/packet.hpp"
#include "esi/recon/esi.hpp"
#include "support/shared_data.hpp"

namespace {

using esi::Event;
using esi::bench::median;
using esi::bench::seconds;

constexpr int kRounds = 31;

struct Stream {
  std::string name;
  esi::SensorSize size;
  std::vector<Event> events;
};

Stream tag_board(const std::filesystem::path& csv) {
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
Stream moving_edge(esi::SensorSize size) {
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

/// What is left of the event loop without decay, polarity and clamp: E += c, store t.
class Floor {
 public:
  explicit Floor(esi::SensorSize size)
      : width_(static_cast<std::uint32_t>(size.width_px)),
        pixels_(static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px)) {}

  void process(std::span<const Event> events) {
    esi::EsiPixel* const pixels = pixels_.data();
    const std::uint32_t width = width_;
    for (const Event& event : events) {
      esi::EsiPixel& pixel = pixels[event.y * width + event.x];
      pixel = {pixel.e + 1.0F, static_cast<std::int32_t>(event.t_us)};
    }
  }

 private:
  std::uint32_t width_;
  std::vector<esi::EsiPixel> pixels_;
};

/// As in a pipeline: packets come one after another in the same buffer. Copying into it isn't timed.
template <class Target>
double seconds_for(const Stream& stream, Target& target) {
  std::vector<Event> packet(esi::kPacketEvents);
  double sum_s = 0.0;
  for (std::size_t i = 0; i < stream.events.size(); i += packet.size()) {
    const std::size_t count = std::min(packet.size(), stream.events.size() - i);
    std::copy_n(stream.events.begin() + static_cast<std::ptrdiff_t>(i), count, packet.begin());
    sum_s += seconds([&] { target.process(std::span(packet).first(count)); });
  }
  return sum_s;
}

esi::EsiOptions with(esi::Decay decay, double n, double alpha_hz, bool readout_decay) {
  esi::EsiOptions options;
  options.decay.decay = decay;
  options.decay.n = n;
  options.decay.alpha_hz = alpha_hz;
  options.readout_decay = readout_decay;
  return options;
}

struct Variant {
  std::string name;
  esi::EsiOptions options;
};

const std::vector<Variant> kVariants{
    {"power n=2 (cubic)", with(esi::Decay::power, 2.0, 0.0, true)},
    {"polynomial n=1.5 (table)", with(esi::Decay::polynomial, 1.5, 0.0, true)},
    {"exponential (table)", with(esi::Decay::exponential, 1.0, 1.0, true)},
};

void compare_kernels(const Stream& stream) {
  std::vector<double> floor_s;
  std::vector<std::vector<double>> esi_s(kVariants.size());
  std::vector<std::vector<double>> ratios(kVariants.size());
  for (int round = 0; round < kRounds; ++round) {
    Floor floor(stream.size);
    floor_s.push_back(seconds_for(stream, floor));
    for (std::size_t v = 0; v < kVariants.size(); ++v) {
      esi::Esi esi(kVariants[v].options, stream.size);
      esi_s[v].push_back(seconds_for(stream, esi));
      ratios[v].push_back(floor_s.back() / esi_s[v].back());
    }
  }
  const double mega_events = static_cast<double>(stream.events.size()) * 1e-6;
  const std::string where = fmt::format("{} {}", stream.name, to_string(stream.size));
  fmt::print("{:<32} {:<26} {:7.0f} Mev/s\n", where, "floor", mega_events / median(floor_s));
  for (std::size_t v = 0; v < kVariants.size(); ++v) {
    fmt::print("{:<32} {:<26} {:7.0f} Mev/s  {:5.2f} of floor\n", "", kVariants[v].name,
               mega_events / median(esi_s[v]), median(ratios[v]));
  }
}

void compare_readouts(const Stream& stream) {
  const std::int64_t t_us = stream.events.back().t_us + 1;
  cv::Mat1b grey;
  const auto render_us = [&](esi::Esi& esi) { return 1e6 * seconds([&] { esi.render(t_us, grey); }); };
  for (const Variant& variant : kVariants) {
    esi::EsiOptions plain = variant.options;
    plain.readout_decay = false;
    esi::Esi without(plain, stream.size);
    esi::Esi decayed(variant.options, stream.size);
    without.process(stream.events);
    decayed.process(stream.events);
    std::vector<double> without_us;
    std::vector<double> decayed_us;
    std::vector<double> ratios;
    for (int round = 0; round < 5 * kRounds; ++round) {
      without_us.push_back(render_us(without));
      decayed_us.push_back(render_us(decayed));
      ratios.push_back(decayed_us.back() / without_us.back());
    }
    fmt::print("readout {:<24} {:<26} {:7.1f} us without decay, {:.1f} us with: {:.2f} times\n",
               to_string(stream.size), variant.name, median(without_us), median(decayed_us), median(ratios));
  }
}

}  // namespace

int main() {
  const auto csv = esi::test::shared_data("tagboard/tagboard.txyp_us.csv");
  const Stream small = csv ? tag_board(*csv) : moving_edge({346, 260});
  const Stream large = moving_edge({1280, 720});
  for (const Stream* stream : {&small, &large}) compare_kernels(*stream);
  for (const Stream* stream : {&small, &large}) compare_readouts(*stream);
}

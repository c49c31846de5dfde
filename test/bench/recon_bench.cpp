// How fast ESI takes events and makes frames, beside what the memory traffic alone costs, measured in the
// same run, round by round. Ratios carry over to other machines and hours; Mev/s don't.
//   build/release/bin/bench_recon

#include <fmt/format.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "esi/recon/esi.hpp"
#include "recon_streams.hpp"

namespace {

using esi::Event;
using esi::bench::median;
using esi::bench::seconds;
using esi::bench::seconds_for;
using esi::bench::Stream;

constexpr int kRounds = 31;

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
  const std::vector<Stream> all = esi::bench::streams();
  for (const Stream& stream : all) compare_kernels(stream);
  for (const Stream& stream : all) compare_readouts(stream);
}

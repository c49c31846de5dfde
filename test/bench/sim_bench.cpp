// What the simulation costs for each pixel and step, beside an empty loop over the same pixels and steps that
// only adds to one float a pixel, measured in the same run, round by round, on one thread.
//   build/release/bin/bench_sim

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/timing.hpp"
#include "esi/core/json_text.hpp"
#include "esi/sim/simulator.hpp"
#include "support/shared_data.hpp"

namespace {

constexpr int kRounds = 5;
constexpr double kSimulated_s = 0.3;

esi::SimOptions preset(const std::string& name) {
  const auto path = esi::test::source_dir() / "configs" / "sim" / (name + ".json");
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  esi::SimOptions options;
  table_of(options).set_json(esi::parse_json(text, path.string()));
  options.end_s = kSimulated_s;
  return options;
}

struct Costs {
  std::vector<double> simulation_ns;
  std::vector<double> empty_ns;
  std::int64_t steps = 0;
  std::int64_t events = 0;
};

void measure(const esi::SimOptions& options, Costs& costs) {
  esi::Simulator simulator(options, 1);
  const auto pixels = static_cast<std::size_t>(simulator.sensor_size().width_px) *
                      static_cast<std::size_t>(simulator.sensor_size().height_px);
  esi::Packet packet;
  costs.events = 0;
  const double simulation_s = esi::bench::seconds([&] {
    while (simulator.next(packet)) costs.events += static_cast<std::int64_t>(packet.events.size());
  });
  costs.steps = simulator.steps();
  std::vector<float> light(pixels);
  const double empty_s = esi::bench::seconds([&] {
    for (std::int64_t step = 0; step < costs.steps; ++step) {
      for (float& value : light) value += 1.0F;
      asm volatile("" : : "r"(light.data()) : "memory");  // each step happens
    }
  });
  const double ns_per_step = 1e9 / (static_cast<double>(pixels) * static_cast<double>(costs.steps));
  costs.simulation_ns.push_back(simulation_s * ns_per_step);
  costs.empty_ns.push_back(empty_s * ns_per_step);
}

}  // namespace

int main() {
  fmt::print("one thread, medians of {} rounds of {} s at 346x260\n", kRounds, kSimulated_s);
  for (const char* const name : {"flight-indoor", "flight-dim", "flight-dark"}) {
    Costs costs;
    for (int round = 0; round < kRounds; ++round) measure(preset(name), costs);
    const double simulation_ns = esi::bench::median(costs.simulation_ns);
    const double empty_ns = esi::bench::median(costs.empty_ns);
    fmt::print("{:14} {:6.2f} ns a pixel-step, empty loop {:.3f} ns, ratio {:.0f}; {} steps, {} events\n",
               name, simulation_ns, empty_ns, simulation_ns / empty_ns, costs.steps, costs.events);
  }
}

#include "esi/sim/sim_options.hpp"

namespace esi {

void SimOptions::declare_own(OptionTable& table) {
  constexpr Bounds<std::int64_t> kSeeds{0, 1'000'000'000'000};
  table.integer("seed", seed, kSeeds, "", "decides all that is random about the sensor, and nothing else");
  table.integer("scene_seed", scene_seed, kSeeds, "", "decides how the scene looks and how a flight wanders");
  table.optional_real("end_s", end_s, {0.001, 1800.0}, "s",
                      "simulate only what comes before, of the same motion");
}

void SimOptions::declare(OptionTable& table) {
  declare_own(table);
  trajectory.declare(table);
  scene.declare(table);
  camera.declare(table);
  sensor.declare(table);
  frames.declare(table);
  steps.declare(table);
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <optional>

#include "esi/core/options.hpp"
#include "esi/sim/camera.hpp"
#include "esi/sim/exposure.hpp"
#include "esi/sim/scene.hpp"
#include "esi/sim/sensor_options.hpp"
#include "esi/sim/step_plan.hpp"
#include "esi/sim/trajectory.hpp"

namespace esi {

/// Everything that decides what a simulation makes. As JSON one flat object.
struct SimOptions {
  std::int64_t seed = 1;
  std::int64_t scene_seed = 1;
  std::optional<double> end_s;
  TrajectoryOptions trajectory;
  SceneOptions scene;
  CameraOptions camera;
  SensorOptions sensor;
  IntensityFrameOptions frames;
  TimeStepOptions steps;

  void declare(OptionTable& table);
  void declare_own(OptionTable& table);  ///< the part of it that isn't in any of the structs
};

}  // namespace esi

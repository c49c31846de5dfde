#pragma once

#include <cstdint>

#include "esi/core/options.hpp"

namespace esi {

/// The pixel, after v2e (Hu, Liu & Delbruck 2021), IEBCS (Joubert et al. 2021) and ESIM (Rebecq et al. 2018).
/// Defaults: an indoor scene at 100 lux.
struct SensorOptions {
  double illuminance_lux = 100.0;
  double dark_current_lux = 0.3;

  bool lowpass = true;
  double cutoff_white_hz = 300.0;
  double cutoff_dark_hz = 30.0;

  double threshold = 0.25;
  double threshold_ratio = 1.0;
  double mismatch = 0.03;
  double refractory_ms = 0.3;
  bool random_start = true;

  double leak_hz = 0.1;
  double shot_hz = 0.5;
  double shot_white_factor = 0.25;
  double shot_on_share = 0.5;
  double hot_share = 0.001;
  double hot_min_hz = 10.0;
  double hot_max_hz = 50.0;

  void declare(OptionTable& table);
  /// Throws a usage Error on values that contradict one another.
  void check() const;

  /// Nominal thresholds: their geometric mean is `threshold`, ON / OFF is `threshold_ratio`.
  double threshold_on() const;
  double threshold_off() const;
};

}  // namespace esi

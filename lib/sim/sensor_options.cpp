#include "esi/sim/sensor_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "esi/core/error.hpp"

namespace esi {

void SensorOptions::declare(OptionTable& table) {
  table.real("illuminance_lux", illuminance_lux, {0.01, 1e6}, "lux", "light on the scene");
  table.real(
      "dark_current_lux", dark_current_lux, {0.0, 1000.0}, "lux",
      "photodiode's dark current, as light on a white scene; compresses contrast in the dark (Lichtsteiner "
      "et al. 2008: it exceeds the signal at 0.1 lux and F/1.2, so 0.3 at F/2)");
  table.toggle("lowpass", lowpass, "photoreceptor of finite bandwidth, as the two cutoffs say");
  table.real("cutoff_white_hz", cutoff_white_hz, {0.01, 1e6}, "Hz",
             "3 dB bandwidth at a white pixel (v2e: 300, 30 in its noisy preset)");
  table.real("cutoff_dark_hz", cutoff_dark_hz, {0.01, 1e6}, "Hz",
             "bandwidth at a black pixel; between the two it grows with intensity (v2e: 7 % of white)");
  table.real("threshold", threshold, {0.01, 5.0}, "ln",
             "contrast threshold C (v2e: 0.2, DAVIS346 0.2 to 0.5)");
  table.real(
      "threshold_ratio", threshold_ratio, {0.1, 10.0}, "",
      "C_on / C_off, their geometric mean being C; real DAVIS recordings show up to 1.7 or its inverse");
  table.real("mismatch", mismatch, {0.0, 1.0}, "ln",
             "deviation of each threshold from pixel to pixel (v2e: 0.02 to 0.05); 0 is off");
  table.real(
      "refractory_ms", refractory_ms, {0.0, 1000.0}, "ms",
      "pause of a pixel after an event, in which it keeps what it memorised (v2e: 0 to 0.5); 0 is off");
  table.toggle("random_start", random_start,
               "begin with every pixel somewhere between its thresholds, not all alike");
  table.real("leak_hz", leak_hz, {0.0, 1000.0}, "Hz",
             "ON events of an unchanging pixel, from the reset switch's leak (v2e: 0.01 to 0.1); 0 is off");
  table.real(
      "shot_hz", shot_hz, {0.0, 1000.0}, "Hz",
      "noise events, ON and OFF together, of a black pixel (v2e: 0.001 to 5; measured at 0.1 lux on the "
      "chip: 5.6 ON, 4.2 OFF, IEBCS); 0 is off");
  table.real("shot_white_factor", shot_white_factor, {0.0, 1.0}, "",
             "times this many noise events at a white pixel (v2e: 0.25)");
  table.real("shot_on_share", shot_on_share, {0.0, 1.0}, "", "share of ON among the noise events");
  table.real("hot_share", hot_share, {0.0, 1.0}, "",
             "share of hot pixels, which fire ON events all the time");
  table.real("hot_min_hz", hot_min_hz, {0.0, 10000.0}, "Hz", "slowest hot pixel");
  table.real("hot_max_hz", hot_max_hz, {0.0, 10000.0}, "Hz", "fastest hot pixel");
}

void SensorOptions::check() const {
  if (hot_min_hz > hot_max_hz) {
    throw usage_error(fmt::format("option hot_min_hz: {} is above hot_max_hz {}", hot_min_hz, hot_max_hz));
  }
  if (cutoff_dark_hz > cutoff_white_hz) {
    throw usage_error(fmt::format("option cutoff_dark_hz: {} is above cutoff_white_hz {}", cutoff_dark_hz,
                                  cutoff_white_hz));
  }
}

double SensorOptions::threshold_on() const { return threshold * std::sqrt(threshold_ratio); }
double SensorOptions::threshold_off() const { return threshold / std::sqrt(threshold_ratio); }

}  // namespace esi

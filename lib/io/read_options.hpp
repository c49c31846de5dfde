#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"

namespace esi {

enum class TimeUnit { automatic, seconds, milliseconds, microseconds, nanoseconds };
enum class TimeZero { automatic, file, first_event };
enum class PolarityCode { automatic, zero_one, minus_plus_one, one_two };

/// How a recording is read. What is not given is taken from the file; what can't be is asked for.
struct ReadOptions {
  std::string size;     ///< "346x260", or empty: from the file
  std::string chip;     ///< the camera's chip, such as "DAVIS346" (AEDAT 2 and 3.1), or empty: from the file
  std::string columns;  ///< order of the text columns, such as "txyp" or "xypt", or empty: from the file
  std::string stream;   ///< which of several event streams (AEDAT 4: id; M3ED: left or right), or empty
  TimeUnit time_unit = TimeUnit::automatic;
  TimeZero time_zero = TimeZero::automatic;
  PolarityCode polarity = PolarityCode::automatic;
  std::int64_t jitter_us = 1000;
  std::int64_t max_backward_us = 1000000;
  double max_unreadable = 0.001;
  double max_outside = 0.01;
  bool strict = false;

  void declare(OptionTable& table);

  /// Throws a usage Error on a malformed size.
  std::optional<SensorSize> sensor_size() const;
};

}  // namespace esi

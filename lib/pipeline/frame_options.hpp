#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "esi/core/frame_schedule.hpp"
#include "esi/core/options.hpp"
#include "esi/core/time.hpp"
#include "esi/pipeline/crop.hpp"

namespace esi {

/// When frames are made and of which part of the recording.
struct FrameOptions {
  double fps = 100;
  std::int64_t every_events = 0;  ///< 0: at the fixed rate
  std::string times;              ///< a file with one time (s) a line, or empty
  bool packets = false;
  bool at_frames = false;
  std::optional<double> start_s;
  std::optional<double> end_s;
  std::optional<double> duration_s;
  std::string roi;  ///< "X,Y,WxH", or empty
  std::int64_t max_frames = 1'000'000;

  void declare(OptionTable& table);

  /// Throws a usage Error where options exclude each other.
  void check() const;

  /// What --start, --end and --duration leave.
  Interval interval() const;
  /// The region of interest, if there is one.
  std::optional<Region> region() const;
  /// The nominal rate of a video: fps, or 100 where frames don't come at a fixed rate.
  double video_fps() const;

  /// Reads the file of times, if there is one.
  std::unique_ptr<FrameSchedule> make_schedule() const;
};

/// Which part of a recording is used from the one, when frames are due from the other.
FrameOptions with_schedule_of(FrameOptions part, const FrameOptions& schedule);

}  // namespace esi

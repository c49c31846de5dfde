#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "esi/io/check/event_rate.hpp"
#include "esi/io/check/gaps.hpp"
#include "esi/io/check/pixel_counts.hpp"
#include "esi/io/recording_info.hpp"

namespace esi {

/// Whether a recording is good: the answer to --info --check.
struct CheckReport {
  EventRate rate;
  std::int64_t gap_limit_us = 0;
  std::vector<Interval> gaps;
  std::vector<HotPixel> hot_pixels;
  bool counted_pixels = true;         ///< false where the coordinates are too large for it
  std::vector<std::string> findings;  ///< what a person should know, a sentence each; none: it is good

  bool is_good() const { return findings.empty(); }
};

/// Reads a recording to its end, into `info` as well. Throws what its source throws.
CheckReport check_recording(EventSource& source, RecordingInfo& info);

/// "12,40 13,41": as a list of hot pixels is written on a command line or in a config.
std::string hot_pixel_list(const std::vector<HotPixel>& pixels);

nlohmann::json to_json(const CheckReport& report, const RecordingInfo& info);
/// The same for people, one fact a line.
std::string to_text(const CheckReport& report);

}  // namespace esi

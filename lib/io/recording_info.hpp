#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "esi/io/event_digest.hpp"
#include "esi/io/event_source.hpp"

namespace esi {

/// What a recording holds: the answer to --info.
struct RecordingInfo {
  RecordingHeader header;
  std::optional<SensorSize> sensor;
  EventDigest digest;
  std::int64_t time_zero_us = 0;
  std::int64_t intensity_frames = 0;
  Losses losses;

  /// The first event's time in the recording's own clock.
  std::optional<std::int64_t> t_first_us() const;
};

/// Reads a recording to its end, and shows every packet to `look`, if there is one. Throws what its source
/// throws.
RecordingInfo inspect(EventSource& source, const std::function<void(const Packet&)>& look = {});

/// The fields of contract.md; `dropped` and `damaged` by reason.
nlohmann::json to_json(const RecordingInfo& info);

/// The same for people, one fact a line.
std::string to_text(const RecordingInfo& info);

/// {"outside_sensor": 3, ...}: every reason, also those that did not happen.
nlohmann::json dropped_json(const Losses& losses);
nlohmann::json damaged_json(const Losses& losses);

}  // namespace esi

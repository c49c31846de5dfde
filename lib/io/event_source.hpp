#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "esi/core/packet.hpp"
#include "esi/io/format_reader.hpp"
#include "esi/io/losses.hpp"
#include "esi/io/read_options.hpp"

namespace esi {

/// A recording as events: pulled packet by packet, forward only, in bounded memory.
/// Events are sorted by time and, where the sensor's size is known, inside the sensor. Nobody re-checks.
class EventSource {
 public:
  virtual ~EventSource() = default;

  virtual const RecordingHeader& header() const = 0;

  /// From the options, else from the file; empty where neither has it.
  virtual std::optional<SensorSize> sensor_size() const = 0;

  /// Replaces the packet's content. False, with an empty packet, at the end.
  virtual bool next(Packet& packet) = 0;

  virtual const Losses& losses() const = 0;

  /// What was subtracted from the recording's own times: 0, or the first event's time. Known after next().
  virtual std::int64_t time_zero_us() const = 0;

  /// Where the recording is known to go on after its last event here, because it was cut: up to this time.
  virtual std::optional<std::int64_t> cut_at_us() const { return std::nullopt; }

  /// How much of the recording has been read, 0 to 1, where that can be told. For progress only.
  virtual std::optional<double> fraction_read() const { return std::nullopt; }
};

/// Opens a recording ("-" is standard input). Throws an Error "NAME: what, where, what to do".
std::unique_ptr<EventSource> open_recording(const std::filesystem::path& path, const ReadOptions& options);

/// The sensor size, or a usage Error that asks for --size.
SensorSize require_sensor_size(const EventSource& source, const std::string& name);

}  // namespace esi

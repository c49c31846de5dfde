#include "fuzz/targets.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/event_gate.hpp"
#include "esi/io/ground_truth.hpp"
#include "esi/io/zip.hpp"
#include "esi/pipeline/recon_config.hpp"

// libhdf5 loses some memory where it gives up on a damaged file.
extern "C" const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace esi::fuzz {
namespace {

void require(bool kept, std::string_view promise) {
  if (kept) return;
  std::cerr << "broken promise: " << promise << "\n";
  std::abort();
}

/// A file in memory, but with a path: some readers open their file by it, and libhdf5 asks for the real one.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::uint8_t> bytes) {
    const int file = mkstemp(path_.data());
    const auto size = static_cast<ssize_t>(bytes.size());
    require(file >= 0 && write(file, bytes.data(), bytes.size()) == size, "the file in memory is written");
    close(file);
  }
  ~MemoryFile() { unlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_ = "/dev/shm/esi-fuzz-XXXXXX";
};

void check_packet(const Packet& packet, SensorSize size, std::int64_t& newest_us) {
  require(packet.events.size() < 100 * kPacketEvents, "packets are bounded");
  for (const Event& event : packet.events) {
    require(event.t_us >= newest_us, "events are sorted");
    require(size.contains(event.x, event.y), "events are inside the sensor");
    newest_us = event.t_us;
  }
  for (const IntensityFrame& frame : packet.frames) {
    require(!frame.image.empty() && frame.image.channels() == 1, "frames are grey images");
    require(frame.exposure.begin_us <= frame.exposure.end_us, "exposures don't end before they begin");
  }
}

std::int64_t read_to_end(EventSource& source) {
  constexpr SensorSize kAnywhere{kMaxSensorSide_px, kMaxSensorSide_px};
  const SensorSize size = source.sensor_size().value_or(kAnywhere);
  std::int64_t newest_us = INT64_MIN;
  std::int64_t events = 0;
  Packet packet;
  while (source.next(packet)) {
    check_packet(packet, size, newest_us);
    events += static_cast<std::int64_t>(packet.events.size());
  }
  require(packet.events.empty() && packet.frames.empty(), "nothing comes with the end");
  return events;
}

std::int64_t run_reader(const Format& format, std::span<const std::uint8_t> bytes) {
  const MemoryFile file(bytes);
  auto source = std::make_unique<ByteSource>(file.path());
  if (!format.recognises(source->peek(kFormatHeadBytes))) return 0;
  ReadOptions options;
  options.max_outside = 1.0;
  options.max_unreadable = 1.0;
  EventGate gate(format.open(std::move(source), options), options, "fuzz");
  return read_to_end(gate);
}

std::int64_t run_zip(std::span<const std::uint8_t> bytes) {
  const MemoryFile file(bytes);
  return looks_like_zip(std::as_bytes(bytes)) ? read_to_end(*open_recording(file.path(), {})) : 0;
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// What a config is taken for, it must print, and take again.
std::int64_t run_config(std::string_view text) {
  ReconConfig config;
  config.set_json(parse_json(text, "fuzz"), "fuzz");
  ReconConfig again;
  again.set_json(config.json(), "fuzz");
  require(again.json() == config.json(), "a config prints itself");
  return 1;
}

std::int64_t run_ground_truth(std::string_view text) {
  const GroundTruth truth = parse_ground_truth(text, "fuzz");
  require(!truth.phases.empty(), "there are phases");
  for (std::size_t i = 0; i < truth.phases.size(); ++i) {
    require(!truth.phases[i].interval.is_empty(), "no phase is empty");
    require(i == 0 || truth.phases[i].interval.begin_us >= truth.phases[i - 1].interval.end_us,
            "phases come by time and don't overlap");
  }
  return 1;
}

}  // namespace

std::vector<std::string> targets() {
  std::vector<std::string> names = {"config", "ground-truth", "zip"};
  for (const Format& format : formats()) names.emplace_back(format.name);
  return names;
}

std::int64_t run(const std::string& target, std::span<const std::uint8_t> bytes) {
  try {
    if (target == "config") return run_config(text_of(bytes));
    if (target == "ground-truth") return run_ground_truth(text_of(bytes));
    if (target == "zip") return run_zip(bytes);
    const auto format = std::find_if(formats().begin(), formats().end(),
                                     [&](const Format& row) { return row.name == target; });
    require(format != formats().end(), "the target exists");
    return run_reader(*format, bytes);
  } catch (const Error& error) {
    require(std::string_view(error.what()).size() > 10, "an error is a sentence");
    return 0;
  }
}

}  // namespace esi::fuzz

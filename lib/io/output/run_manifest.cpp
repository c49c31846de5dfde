#include "esi/io/output/run_manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <ctime>

#include "esi/core/json_text.hpp"
#include "esi/core/version.hpp"
#include "esi/io/recording_info.hpp"

namespace esi {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

nlohmann::json recording_json(const RunManifest& manifest) {
  const auto t_first_us = manifest.digest.t_first_us();
  return {
      {"path", manifest.recording},
      {"format", manifest.header.format},
      {"layout", manifest.header.layout},
      {"width", manifest.size.width_px},
      {"height", manifest.size.height_px},
      {"time_zero_us", manifest.time_zero_us},
      {"t_first_us", t_first_us ? nlohmann::json(*t_first_us + manifest.time_zero_us) : nlohmann::json()},
      {"duration_us", manifest.digest.duration_us()},
      {"notes", manifest.header.notes},
  };
}

nlohmann::json events_json(const RunManifest& manifest) {
  const std::int64_t used = manifest.digest.events();
  return {
      {"read", used + manifest.losses.dropped()},
      {"used", used},
      {"on", manifest.digest.on()},
      {"crc32", manifest.digest.crc32()},
      {"dropped", dropped_json(manifest.losses)},
      {"damaged", damaged_json(manifest.losses)},
  };
}

}  // namespace

nlohmann::json to_json(const RunManifest::Run& run) {
  return {{"threads", run.threads},
          {"wall_s", run.wall_s},
          {"host", host_name()},
          {"date", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}};
}

std::string to_text(const RunManifest& manifest) {
  const nlohmann::json json = {
      {"tool", manifest.tool},
      {"version", version()},
      {"recording", recording_json(manifest)},
      {"events", events_json(manifest)},
      {"intensity_frames", manifest.intensity_frames},
      {"frames", manifest.frames},
      {"steps", manifest.steps},
      {"files", manifest.files},
      {"config", manifest.config},
      {"fingerprint", manifest.fingerprint},
      {"run", to_json(manifest.run)},
  };
  return json_text(json);
}

}  // namespace esi

#include "esi/io/ground_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "esi/core/error.hpp"
#include "esi/core/event.hpp"
#include "esi/core/json_text.hpp"
#include "esi/core/options.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

using nlohmann::json;

constexpr double kLongest_s = 1e9;
constexpr double kLargest = 1e6;  // px, m, and coefficients of distortion: beyond it, it is a mistake

void require(const json& object, const std::vector<std::string>& keys) {
  if (!object.is_object()) throw usage_error("it is not a JSON object");
  for (const std::string& key : keys) {
    if (!object.contains(key)) throw usage_error(fmt::format("{} is missing", key));
  }
}

/// Says where in the document `read` failed.
template <class Read>
auto within(const std::string& where, Read read) {
  try {
    return read();
  } catch (const Error& error) {
    throw usage_error(fmt::format("{}: {}", where, error.what()));
  }
}

double number(const json& value, double least, double most) {
  double result = 0;
  OptionTable table;
  table.real("value", result, {least, most}, "", "");
  table.at("value").set_json(value);
  return result;
}

Phase read_phase(const json& object) {
  require(object, {"name", "start_s", "end_s"});
  Phase phase;
  double start_s = 0, end_s = 0;
  OptionTable table;
  table.text("name", phase.name, "");
  table.real("start_s", start_s, {-kLongest_s, kLongest_s}, "s", "");
  table.real("end_s", end_s, {-kLongest_s, kLongest_s}, "s", "");
  table.set_json(object);
  phase.interval = {us_from_seconds(start_s), us_from_seconds(end_s)};
  if (phase.name.empty()) throw usage_error("its name is empty");
  if (phase.interval.is_empty())
    throw usage_error(fmt::format("end_s ({}) is not after start_s ({})", end_s, start_s));
  return phase;
}

void refuse_clashes(const std::vector<Phase>& phases) {
  for (std::size_t i = 1; i < phases.size(); ++i) {
    const Phase& before = phases[i - 1];
    if (phases[i].interval.begin_us >= before.interval.end_us) continue;
    throw usage_error(fmt::format("phases: {} and {} overlap from {} s on; each time can be in one phase",
                                  json(before.name).dump(), json(phases[i].name).dump(),
                                  seconds_text(phases[i].interval.begin_us)));
  }
  for (auto phase = phases.begin(); phase != phases.end(); ++phase) {
    const auto is_same = [&](const Phase& other) { return other.name == phase->name; };
    if (std::none_of(phases.begin(), phase, is_same)) continue;
    throw usage_error(fmt::format("phases: the name {} is there twice", json(phase->name).dump()));
  }
}

std::vector<Phase> read_phases(const json& list) {
  if (!list.is_array() || list.empty()) throw usage_error("phases: it must be a list of at least one phase");
  std::vector<Phase> phases;
  for (const json& entry : list) {
    phases.push_back(within(fmt::format("phases[{}]", phases.size()), [&] { return read_phase(entry); }));
  }
  std::sort(phases.begin(), phases.end(),
            [](const Phase& a, const Phase& b) { return a.interval.begin_us < b.interval.begin_us; });
  refuse_clashes(phases);
  return phases;
}

int read_id(const json& value) {
  std::int64_t id = 0;
  OptionTable table;
  table.integer("id", id, {0, 100000}, "", "");
  table.at("id").set_json(value);
  return static_cast<int>(id);
}

std::map<int, double> read_sizes(const json& object, const std::vector<int>& ids) {
  require(object, {});
  std::map<int, double> sizes;
  for (const auto& [key, value] : object.items()) {
    int id = -1;
    const auto [stop, error] = std::from_chars(key.data(), key.data() + key.size(), id);
    const bool is_number = error == std::errc{} && stop == key.data() + key.size();
    if (!is_number || std::find(ids.begin(), ids.end(), id) == ids.end()) {
      throw usage_error(fmt::format("{} is none of the ids", json(key).dump()));
    }
    sizes[id] = within(key, [&value = value] { return number(value, 1e-6, kLargest); });
  }
  return sizes;
}

TrueTags read_tags(const json& object) {
  require(object, {"family", "ids"});
  TrueTags tags;
  for (const auto& [key, value] : object.items()) {
    if (key == "family") {
      if (!value.is_string()) throw usage_error("family: give a name such as \"tag36h11\"");
      tags.family = value.get<std::string>();
    } else if (key == "ids") {
      if (!value.is_array() || value.empty()) throw usage_error("ids: it must be a list of at least one id");
      for (const json& id : value) tags.ids.push_back(within("ids", [&] { return read_id(id); }));
    } else if (key != "size_m") {
      throw usage_error(fmt::format("there is no {}; known are family, ids, size_m", json(key).dump()));
    }
  }
  std::vector<int> sorted = tags.ids;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) throw usage_error(fmt::format("ids: {} is there twice", *twice));
  if (object.contains("size_m")) {
    tags.size_m = within("size_m", [&] { return read_sizes(object["size_m"], tags.ids); });
  }
  return tags;
}

CameraModel read_camera(json object) {
  require(object, {"width", "height", "fx", "fy", "cx", "cy"});
  CameraModel camera;
  if (object.contains("distortion")) {
    const json& list = object["distortion"];
    if (!list.is_array()) throw usage_error("distortion: it must be a list of numbers");
    for (const json& value : list) {
      camera.distortion.push_back(within("distortion", [&] { return number(value, -kLargest, kLargest); }));
    }
    object.erase("distortion");
  }
  std::int64_t width_px = 0, height_px = 0;
  OptionTable table;
  table.integer("width", width_px, {1, kMaxSensorSide_px}, "px", "");
  table.integer("height", height_px, {1, kMaxSensorSide_px}, "px", "");
  table.real("fx", camera.fx, {1e-3, kLargest}, "px", "");
  table.real("fy", camera.fy, {1e-3, kLargest}, "px", "");
  table.real("cx", camera.cx, {-kLargest, kLargest}, "px", "");
  table.real("cy", camera.cy, {-kLargest, kLargest}, "px", "");
  table.set_json(object);
  camera.width_px = static_cast<int>(width_px);
  camera.height_px = static_cast<int>(height_px);
  return camera;
}

/// Everything but the objects: the files.
void read_files(json object, const std::filesystem::path& folder, GroundTruth& truth) {
  for (const char* const key : {"phases", "tags", "camera"}) object.erase(key);
  struct File {
    const char* key;
    std::filesystem::path* path;
    std::string text;
  };
  File files[] = {{"corners", &truth.corners, {}},
                  {"target_poses", &truth.target_poses, {}},
                  {"camera_poses", &truth.camera_poses, {}},
                  {"clean_frames", &truth.clean_frames, {}}};
  OptionTable table;
  for (File& file : files) table.text(file.key, file.text, "");
  table.set_json(object);
  for (const File& file : files) {
    if (file.text.find('\0') != std::string::npos) throw usage_error(fmt::format("{}: no path", file.key));
    if (!file.text.empty()) *file.path = folder / file.text;
  }
}

GroundTruth from_json(const json& object, const std::filesystem::path& folder) {
  require(object, {"phases"});
  GroundTruth truth;
  truth.phases = read_phases(object["phases"]);
  if (object.contains("tags")) truth.tags = within("tags", [&] { return read_tags(object["tags"]); });
  if (object.contains("camera"))
    truth.camera = within("camera", [&] { return read_camera(object["camera"]); });
  read_files(object, folder, truth);
  return truth;
}

}  // namespace

GroundTruth parse_ground_truth(std::string_view text, const std::filesystem::path& path) {
  const json object = parse_json(text, path.string());
  return within(path.string(), [&] { return from_json(object, path.parent_path()); });
}

GroundTruth read_ground_truth(const std::filesystem::path& path) {
  return parse_ground_truth(read_text_file(path), path);
}

void require_overlap(const GroundTruth& truth, Interval recording, bool is_whole, const std::string& name) {
  const auto overlaps = [](const Interval& a, const Interval& b) {
    return a.begin_us < b.end_us && b.begin_us < a.end_us;
  };
  const auto has_part = [&](const Phase& phase) { return overlaps(phase.interval, recording); };
  const bool is_in_part = std::any_of(truth.phases.begin(), truth.phases.end(), has_part);
  const Interval phases{truth.phases.front().interval.begin_us, truth.phases.back().interval.end_us};
  const Interval as_milliseconds{phases.begin_us / 1000, phases.end_us / 1000};
  const bool may_be_milliseconds =
      overlaps(as_milliseconds, recording) && as_milliseconds.end_us > recording.end_us / 10;
  const bool fit_as_milliseconds = may_be_milliseconds && as_milliseconds.end_us > recording.end_us / 2 &&
                                   as_milliseconds.end_us < 2 * recording.end_us;
  if (is_in_part && !(is_whole && fit_as_milliseconds)) return;
  throw usage_error(fmt::format("{}: the phases lie from {} s to {} s, the recording from {} s to {} s{}",
                                name, seconds_text(phases.begin_us), seconds_text(phases.end_us),
                                seconds_text(recording.begin_us), seconds_text(recording.end_us),
                                may_be_milliseconds
                                    ? "; are they in milliseconds? Phases are given in seconds"
                                    : "; check --time-zero and the phases"));
}

}  // namespace esi

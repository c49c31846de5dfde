#include "esi/pipeline/sim_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

constexpr std::string_view kFormats[] = {"h5", "aedat4", "txt"};
constexpr Bounds<double> kRates_hz{0.01, 10000.0};

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return parts;
}

void check_formats(const std::string& text) {
  for (const std::string_view name : split_at_commas(text)) {
    if (std::find(std::begin(kFormats), std::end(kFormats), name) != std::end(kFormats)) continue;
    throw usage_error(fmt::format("option write: '{}' is not possible, give some of {}, with commas between",
                                  name, fmt::join(kFormats, ", ")));
  }
}

}  // namespace

void SimOutputOptions::declare(OptionTable& table) {
  table.text("write", write, "formats of the recording, with commas between: h5 (DSEC's layout), aedat4, txt",
             check_formats);
  table.toggle("labels", labels,
               "labels.u8: what made each event, a byte each: 0 signal, 1 shot noise, 2 hot");
  table.toggle("clean_frames", clean_frames, "clean/: pictures of the scene without sensor, noise and blur");
  table.real("clean_fps", clean_fps, kRates_hz, "1/s", "clean pictures per second");
  table.real("corners_hz", corners_hz, kRates_hz, "1/s", "rows of corners.csv per second and tag");
  table.real("poses_hz", poses_hz, kRates_hz, "1/s", "lines of target.tum and camera.tum per second");
  table.toggle("preview", preview, "preview.mp4: events, and beside them the latest intensity frame");
  table.real("preview_fps", preview_fps, {1.0, 1000.0}, "1/s", "frames per second of the preview");
  table.toggle("force", force, "replace an older simulation in the output folder");
}

std::vector<std::string> SimOutputOptions::formats() const {
  const auto wanted = split_at_commas(write);
  std::vector<std::string> formats;
  for (const std::string_view name : kFormats) {
    if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) formats.emplace_back(name);
  }
  return formats;
}

void SimConfig::declare(OptionTable& table) {
  sim.declare(table);
  output.declare(table);
}

void SimConfig::set_json(const nlohmann::json& config, const std::string& name) {
  if (!config.is_object()) throw usage_error(name + ": a config is a JSON object of names and values");
  OptionTable table;
  declare(table);
  try {
    table.set_json(config);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()), error.kind());
  }
}

void SimConfig::load(const std::filesystem::path& file) {
  set_json(parse_json(read_text_file(file), file.string()), file.string());
}

void SimConfig::set(std::string_view assignment) {
  OptionTable table;
  declare(table);
  table.set_assignment(assignment);
}

nlohmann::json SimConfig::json() const {
  SimConfig copy = *this;  // tables bind to fields that aren't const
  OptionTable table;
  copy.declare(table);
  return table.json();
}

std::vector<OptionGroup> SimConfig::groups() {
  OptionTable whole;
  sim.declare_own(whole);
  return {{"Simulation", whole},
          {"Motion", table_of(sim.trajectory)},
          {"Scene", table_of(sim.scene)},
          {"Camera", table_of(sim.camera)},
          {"Pixels", table_of(sim.sensor)},
          {"Intensity frames", table_of(sim.frames)},
          {"Steps", table_of(sim.steps)},
          {"Output", table_of(output)}};
}

}  // namespace esi

#include "esi/pipeline/evaluation/eval_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

template <class Options>
nlohmann::json json_of(Options options) {
  return table_of(options).json();
}

void refuse_input_options(const EvalMethod& method) {
  if (json_of(method.config.read) == json_of(ReadOptions{})) return;
  throw usage_error(fmt::format(
      "method {}: its config says how the recording is read, which all methods share; give those options to "
      "esi-eval itself",
      method.label));
}

void refuse_part_options(const EvalMethod& method) {
  const FrameOptions& own = method.config.frames;
  if (json_of(with_schedule_of(own, {})) == json_of(FrameOptions{})) return;
  throw usage_error(fmt::format(
      "method {}: its config says which part of the recording is used, which all methods share; give those "
      "options to esi-eval itself",
      method.label));
}

}  // namespace

void JudgingOptions::declare(OptionTable& table) {
  declare_selection(table);
  table.toggle("quality", quality, "compare with clean frames where the truth has them");
  table.toggle("tracking", tracking, "track the target where the truth has poses");
}

void JudgingOptions::declare_selection(OptionTable& table) {
  table.text("ids", ids, "tags that are expected, such as 0,1, instead of the truth's",
             [](const std::string& text) { JudgingOptions{.ids = text}.id_list(); });
  table.integer("stride", stride, {1, 1'000'000}, "frames", "look at one frame of so many");
}

std::vector<int> JudgingOptions::id_list() const {
  std::vector<int> list;
  const char* at = ids.data();
  const char* const end = at + ids.size();
  while (at != end) {
    int id = 0;
    const auto [stop, error] = std::from_chars(at, end, id);
    const bool ends_well = stop == end || (*stop == ',' && stop + 1 != end);
    if (error != std::errc{} || id < 0 || !ends_well) {
      throw usage_error(fmt::format("option ids: '{}' is no list of numbers such as 0,1", ids));
    }
    if (std::find(list.begin(), list.end(), id) != list.end()) {
      throw usage_error(fmt::format("option ids: {} is there twice", id));
    }
    list.push_back(id);
    at = stop == end ? end : stop + 1;
  }
  return list;
}

void EvalConfig::add(EvalMethod method) {
  const auto has_label = [&](const EvalMethod& other) { return other.label == method.label; };
  if (std::any_of(methods.begin(), methods.end(), has_label)) {
    throw usage_error(fmt::format(
        "method {} is given twice; a config file of another name gets another label", method.label));
  }
  refuse_input_options(method);
  refuse_part_options(method);
  methods.push_back(std::move(method));
}

void EvalConfig::add_method(const std::string& name_or_file) {
  EvalMethod method;
  method.config.choose_method(name_or_file);
  method.label =
      name_or_file.ends_with(".json") ? std::filesystem::path(name_or_file).stem().string() : name_or_file;
  add(std::move(method));
}

void EvalConfig::set_json(const nlohmann::json& config, const std::string& name) {
  if (!config.is_object()) throw usage_error(name + ": a config is a JSON object of names and values");
  try {
    OptionTable all;
    declare(all);
    for (const auto& [key, value] : config.items()) {
      if (key != "methods") all.at(key).set_json(value);
    }
    if (!config.contains("methods")) return;
    if (!config["methods"].is_array()) throw usage_error("methods: give a list of names, files or configs");
    for (const auto& entry : config["methods"]) {
      if (entry.is_string()) {
        add_method(entry.get<std::string>());
        continue;
      }
      if (!entry.is_object() || !entry.contains("label") || !entry["label"].is_string()) {
        throw usage_error("methods: each is a name, a file, or a config with a \"label\"");
      }
      EvalMethod method;
      method.label = entry["label"].get<std::string>();
      if (method.label.empty()) throw usage_error("methods: a label is empty");
      auto own = entry;
      own.erase("label");
      method.config.set_json(own, method.label);
      add(std::move(method));
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()), error.kind());
  }
}

void EvalConfig::load(const std::filesystem::path& file) {
  set_json(parse_json(read_text_file(file), file.string()), file.string());
}

nlohmann::json EvalConfig::json() const {
  EvalConfig copy;  // tables bind to fields that aren't const
  copy.read = read;
  copy.frames = frames;
  copy.detector = detector;
  copy.score = score;
  copy.judging = judging;
  copy.tracking = tracking;
  copy.pose_noise = pose_noise;
  OptionTable all;
  copy.declare(all);
  nlohmann::json config = all.json();
  config["methods"] = nlohmann::json::array();
  const nlohmann::json defaults = ReconConfig().json();
  for (const EvalMethod& method : methods) {
    nlohmann::json own = method.config.json();
    for (const auto& [key, value] : defaults.items()) {
      if (key != "method" && key != "set" && own[key] == value) own.erase(key);
    }
    own["label"] = method.label;
    config["methods"].push_back(std::move(own));
  }
  return config;
}

void EvalConfig::declare(OptionTable& table) {
  read.declare(table);
  frames.declare(table);
  detector.declare(table);
  score.declare(table);
  judging.declare(table);
  tracking.declare(table);
  pose_noise.declare(table);
}

void EvalConfig::check() const {
  frames.check();
  detector.check();
  for (const EvalMethod& method : methods) {
    frames_of(method).check();
    method.config.steps.check();
  }
}

FrameOptions EvalConfig::frames_of(const EvalMethod& method) const {
  const bool has_own = json_of(with_schedule_of({}, method.config.frames)) != json_of(FrameOptions{});
  return has_own ? with_schedule_of(frames, method.config.frames) : frames;
}

std::vector<OptionGroup> EvalConfig::groups() {
  return {{"Input", table_of(read)},         {"Frames", table_of(frames)},
          {"Detection", table_of(detector)}, {"Score", table_of(score)},
          {"Judging", table_of(judging)},    {"Tracking", table_of(tracking)},
          {"Own pose", table_of(pose_noise)}};
}

}  // namespace esi

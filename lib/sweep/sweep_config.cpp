#include "esi/sweep/sweep_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

constexpr double kMostCells = 1'000'000;

ReconConfig copy_of(const ReconConfig& config) {
  ReconConfig copy;
  copy.set_json(config.json(), "config");
  return copy;
}

/// Large enough for any method to be made, which is when options that don't go together are found.
constexpr SensorSize kTrialSize{32, 32};

/// `before`: the position of the cell whose values the options have; empty where they have none of a cell.
std::vector<std::size_t> set_values(std::vector<VariableOption>& options, const SweepGrid& grid,
                                    std::size_t cell, const std::vector<std::size_t>& before) {
  std::vector<std::size_t> position = grid.position(cell);
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!before.empty() && before[i] == position[i]) continue;
    const SweepAxis& axis = grid.axes()[i];
    option_named(options, axis.option).set_text(axis.values[position[i]]);
  }
  return position;
}

/// Cells that see other frames can't be compared frame by frame, which halving lives on.
void refuse_schedules_without_effect(const SweepConfig& config, const SweepGrid& grid) {
  const FrameOptions& frames = config.base.frames;
  for (const SweepAxis& axis : grid.axes()) {
    if (axis.option != "fps" && axis.option != "every_events") continue;
    if (config.search.search == SearchOptions::Search::halving) {
      throw usage_error(fmt::format("grid {}: halving compares cells on the same frames", axis.option));
    }
    const bool is_fixed = !frames.times.empty() || frames.packets || frames.at_frames ||
                          (axis.option == "fps" && frames.every_events > 0);
    if (is_fixed)
      throw usage_error(fmt::format("grid {}: another option says when frames are due", axis.option));
  }
}

void refuse_too_many(const std::vector<SweepAxis>& axes) {
  double cells = 1.0;
  for (const SweepAxis& axis : axes) cells *= static_cast<double>(axis.values.size());
  if (cells <= kMostCells) return;
  throw usage_error(fmt::format("the grid has {:.6g} cells, more than {:.0f}; use fewer or shorter axes",
                                cells, kMostCells));
}

std::vector<AskedAxis> axes_from(const nlohmann::json& grid) {
  std::vector<AskedAxis> axes;
  if (grid.is_object()) {
    for (const auto& [option, values] : grid.items()) axes.push_back(parse_axis(option, values));
    return axes;
  }
  if (!grid.is_array()) throw usage_error("grid: give an object of options and their values");
  for (const auto& entry : grid) {
    if (!entry.is_object() || !entry.contains("option") || !entry["option"].is_string() ||
        !entry.contains("values")) {
      throw usage_error("grid: each entry of a list has an \"option\" and its \"values\"");
    }
    axes.push_back(parse_axis(entry["option"].get<std::string>(), entry["values"]));
    if (entry.value("logarithmic", false)) axes.back().is_logarithmic = true;
  }
  return axes;
}

std::vector<EvalInput> inputs_from(const nlohmann::json& list, const std::filesystem::path& folder) {
  constexpr const char* kForm = "recordings: give a list of {\"recording\": FILE, \"ground_truth\": FILE}";
  if (!list.is_array()) throw usage_error(kForm);
  std::vector<EvalInput> inputs;
  for (const auto& entry : list) {
    const bool is_whole = entry.is_object() && entry.size() == 2 && entry.contains("recording") &&
                          entry["recording"].is_string() && entry.contains("ground_truth") &&
                          entry["ground_truth"].is_string();
    if (!is_whole) throw usage_error(kForm);
    const auto path_of = [&](const char* key) {
      return (folder / entry[key].get<std::string>()).lexically_normal();
    };
    inputs.push_back({path_of("recording"), path_of("ground_truth"), false});
  }
  return inputs;
}

}  // namespace

void SearchOptions::declare(OptionTable& table) {
  table.choice("search", search, {"full", "halving"},
               "judge every cell on all frames, or drop cells that fall behind on the first ones");
  table.integer("first_stride", first_stride, {1, 1024}, "",
                "halving begins with one frame of so many, a power of two");
  table.text("objective", objective, "the phase whose rate decides which cell is best, or total");
}

void SearchOptions::check() const {
  if ((first_stride & (first_stride - 1)) == 0) return;
  throw usage_error(fmt::format("option first_stride: {} is no power of two", first_stride));
}

void SweepConfig::add_axis(AskedAxis axis) {
  std::erase_if(asked_, [&](const AskedAxis& other) { return other.option == axis.option; });
  asked_.push_back(std::move(axis));
}

void SweepConfig::set_json(const nlohmann::json& config, const std::string& name,
                           const std::filesystem::path& folder) {
  if (!config.is_object()) throw usage_error(name + ": a config is a JSON object of names and values");
  nlohmann::json own = config;
  try {
    if (const auto grid = own.find("grid"); grid != own.end()) {
      for (AskedAxis& axis : axes_from(*grid)) add_axis(std::move(axis));
      own.erase(grid);
    }
    if (const auto list = own.find("recordings"); list != own.end()) {
      inputs = inputs_from(*list, folder);
      own.erase(list);
    }
    OptionTable judged;
    detector.declare(judged);
    score.declare(judged);
    judging.declare_selection(judged);
    search.declare(judged);
    for (const Option& option : judged.options()) {
      const auto given = own.find(option.name());
      if (given == own.end()) continue;
      judged.at(option.name()).set_json(*given);
      own.erase(given);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()), error.kind());
  }
  base.set_json(own, name);
}

void SweepConfig::load(const std::filesystem::path& file) {
  set_json(parse_json(read_text_file(file), file.string()), file.string(), file.parent_path());
}

nlohmann::json SweepConfig::json() const {
  SweepConfig copy;  // tables bind to fields that aren't const
  copy.detector = detector;
  copy.score = score;
  copy.judging = judging;
  copy.search = search;
  nlohmann::json config = base.json();
  for (const char* key : {"force", "resume", "png_compression"}) config.erase(key);
  for (const OptionGroup& group : copy.groups_besides_base()) config.update(group.table.json());
  config["grid"] = nlohmann::json::array();
  const SweepGrid all = grid();
  for (const SweepAxis& axis : all.axes()) {
    config["grid"].push_back({{"option", axis.option}, {"values", axis.values}});
    if (axis.is_logarithmic) config["grid"].back()["logarithmic"] = true;
  }
  return config;
}

nlohmann::json SweepConfig::json_with_inputs() const {
  nlohmann::json config = json();
  config["recordings"] = nlohmann::json::array();
  for (const EvalInput& input : inputs) {
    config["recordings"].push_back({{"recording", std::filesystem::absolute(input.path).string()},
                                    {"ground_truth", std::filesystem::absolute(input.truth).string()}});
  }
  return config;
}

SweepGrid SweepConfig::grid() const {
  ReconConfig scratch = copy_of(base);
  std::vector<VariableOption> options = variable_options(scratch);
  std::vector<std::pair<std::size_t, SweepAxis>> placed;
  std::set<std::string> varied;
  for (const AskedAxis& asked : asked_) {
    VariableOption& option = option_named(options, asked.option);
    for (const std::string& name : option.option_names()) {
      if (varied.insert(name).second) continue;
      throw usage_error(fmt::format("grid {}: {} is varied by another axis, too", asked.option, name));
    }
    placed.emplace_back(&option - options.data(), checked_axis(asked, option));
  }
  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SweepAxis> axes;
  axes.reserve(placed.size());
  for (auto& [place, axis] : placed) axes.push_back(std::move(axis));
  refuse_too_many(axes);
  return SweepGrid(std::move(axes));
}

ReconConfig SweepConfig::cell_config(const SweepGrid& grid, std::size_t cell) const {
  ReconConfig config = copy_of(base);
  std::vector<VariableOption> options = variable_options(config);
  set_values(options, grid, cell, {});
  return config;
}

EvalConfig SweepConfig::eval_config(const SweepGrid& grid, const std::vector<std::size_t>& cells) const {
  EvalConfig config;
  config.read = base.read;
  config.frames = with_schedule_of(base.frames, {});
  config.detector = detector;
  config.score = score;
  config.judging = judging;
  config.judging.quality = false;
  config.judging.tracking = false;
  for (const std::size_t cell : cells) {
    config.methods.push_back({fmt::format("{}", cell), cell_config(grid, cell)});
  }
  return config;
}

void SweepConfig::check(const std::function<bool()>& goes_on) const {
  search.check();
  detector.check();
  base.frames.check();
  const SweepGrid all = grid();
  refuse_schedules_without_effect(*this, all);
  ReconConfig config = copy_of(base);
  std::vector<VariableOption> options = variable_options(config);
  const bool needs_files = config.method_options().find("model") != nullptr;
  std::vector<std::size_t> position;
  for (std::size_t cell = 0; cell < all.cells() && goes_on(); ++cell) {
    position = set_values(options, all, cell, position);
    config.frames.check();
    config.steps.check();
    if (!needs_files) config.method_config().create(kTrialSize);
  }
}

std::vector<OptionGroup> SweepConfig::groups() {
  std::vector<OptionGroup> all = base.groups();
  std::erase_if(all, [](const OptionGroup& group) { return group.title == "Output"; });
  for (OptionGroup& group : groups_besides_base()) all.push_back(std::move(group));
  return all;
}

std::vector<OptionGroup> SweepConfig::groups_besides_base() {
  OptionTable selection;
  judging.declare_selection(selection);
  return {{"Detection", table_of(detector)},
          {"Score", table_of(score)},
          {"Judging", std::move(selection)},
          {"Search", table_of(search)}};
}

}  // namespace esi

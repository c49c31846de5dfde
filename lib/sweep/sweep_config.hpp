#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "esi/pipeline/evaluation/evaluate.hpp"
#include "esi/sweep/sweep_grid.hpp"

namespace esi {

/// How the best cell is looked for.
struct SearchOptions {
  enum class Search { full, halving };
  Search search = Search::full;
  std::int64_t first_stride = 16;  ///< halving begins with one frame of so many
  std::string objective = "total";

  void declare(OptionTable& table);
  /// Throws a usage Error where halving could not get from its first frames to all by doubling.
  void check() const;
};

/// A sweep: one method, the values of its options that are tried, and how each cell is judged. As JSON:
/// {"method": "esi", "set": {...}, "grid": [{"option": "tau_s", "values": [1, 2]}], "stride": 4, ...}; when
/// written by hand also "grid": {"tau_s": "0.5:2:0.5"} and "recordings": [{"recording": FILE,
/// "ground_truth": FILE}], whose paths are relative to the config file.
class SweepConfig {
 public:
  /// Method, steps, how recordings are read and which frames are made; what the grid doesn't vary.
  ReconConfig base;
  DetectorOptions detector;
  ScoreOptions score;
  JudgingOptions judging;
  SearchOptions search;
  std::vector<EvalInput> inputs;

  void choose_method(const std::string& name_or_file) { base.choose_method(name_or_file); }
  /// Replaces an axis of the same option.
  void add_axis(AskedAxis axis);
  void set_json(const nlohmann::json& config, const std::string& name, const std::filesystem::path& folder);
  void load(const std::filesystem::path& file);
  /// Without recordings.
  nlohmann::json json() const;
  /// With recordings, by absolute paths.
  nlohmann::json json_with_inputs() const;

  /// Axes in the order in which their options are declared, so that it makes no difference how they were
  /// given. Throws a usage Error for an option that the method doesn't have or that can't be swept, for two
  /// axes of one option, for values out of its bounds, and for more cells than any machine would get through.
  SweepGrid grid() const;
  /// The base with a cell's values.
  ReconConfig cell_config(const SweepGrid& grid, std::size_t cell) const;
  /// Some cells as methods that are evaluated together; each is called by its number.
  EvalConfig eval_config(const SweepGrid& grid, const std::vector<std::size_t>& cells) const;
  /// Throws a usage Error on options that contradict one another, in any cell. A million cells take seconds:
  /// once goes_on() says no, the rest is left out.
  void check(const std::function<bool()>& goes_on = [] { return true; }) const;

  std::vector<OptionGroup> groups();

 private:
  std::vector<OptionGroup> groups_besides_base();

  std::vector<AskedAxis> asked_;
};

}  // namespace esi

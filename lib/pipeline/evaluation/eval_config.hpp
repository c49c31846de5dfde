#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "esi/eval/detector_options.hpp"
#include "esi/eval/pose_track.hpp"
#include "esi/eval/score.hpp"
#include "esi/eval/tracking.hpp"
#include "esi/pipeline/recon_config.hpp"

namespace esi {

/// A method under a name of its own: the stem of its config file, or the method's name.
struct EvalMethod {
  std::string label;
  ReconConfig config;
};

/// What is looked at.
struct JudgingOptions {
  std::string ids;          ///< "0,1": expected instead of the truth's
  std::int64_t stride = 1;  ///< every so many frames one is looked at
  bool quality = true;
  bool tracking = true;
  /// The first frame that is looked at; less than the stride. No option: rounds of a sweep's search share
  /// frames out by it.
  std::int64_t first_frame = 0;

  void declare(OptionTable& table);
  /// Only which tags and frames.
  void declare_selection(OptionTable& table);
  /// The list's numbers; empty for an empty list.
  std::vector<int> id_list() const;
};

/// Everything that decides what an evaluation finds. As JSON one flat object, with the methods as names,
/// files or configs with a label: {"methods": ["esi", {"label": "a", "method": "esi", "set": {...}}], "fps":
/// 100, ...}
class EvalConfig {
 public:
  ReadOptions read;
  FrameOptions frames;  ///< for every method whose own config doesn't say when frames are due
  DetectorOptions detector;
  ScoreOptions score;
  JudgingOptions judging;
  TrackingOptions tracking;
  PoseNoise pose_noise;
  std::vector<EvalMethod> methods;

  /// A method's name or a config file. Throws a usage Error where one of that label is there already, and for
  /// a config that says how to read recordings, which all methods share.
  void add_method(const std::string& name_or_file);
  void set_json(const nlohmann::json& config, const std::string& name);
  void load(const std::filesystem::path& file);
  nlohmann::json json() const;
  /// Throws a usage Error on options that contradict one another.
  void check() const;

  /// The frames of a method: its own where its config says when they are due, else everybody's.
  FrameOptions frames_of(const EvalMethod& method) const;

  std::vector<OptionGroup> groups();

 private:
  void add(EvalMethod method);
  void declare(OptionTable& table);
};

}  // namespace esi

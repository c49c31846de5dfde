#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/sim/sim_options.hpp"

namespace esi {

/// What of a simulation is written.
struct SimOutputOptions {
  std::string write = "h5";
  bool labels = false;
  bool clean_frames = false;
  double clean_fps = 100.0;
  double corners_hz = 100.0;
  double poses_hz = 200.0;
  bool preview = false;
  double preview_fps = 25.0;
  bool force = false;

  void declare(OptionTable& table);

  /// The extensions that `write` lists, in the order h5, aedat4, txt.
  std::vector<std::string> formats() const;
};

/// Everything that decides what a simulation writes. As JSON one flat object; configs/sim has examples.
struct SimConfig {
  SimOptions sim;
  SimOutputOptions output;

  /// Takes a config file's content; `name` is what messages call it.
  void set_json(const nlohmann::json& config, const std::string& name);
  void load(const std::filesystem::path& file);
  /// "key=value"
  void set(std::string_view assignment);

  nlohmann::json json() const;

  /// The options by group, for flags and --help. They point into this object.
  std::vector<OptionGroup> groups();

 private:
  void declare(OptionTable& table);
};

}  // namespace esi

#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "esi/io/output/frame_sink.hpp"
#include "esi/io/read_options.hpp"
#include "esi/pipeline/frame_options.hpp"
#include "esi/pipeline/step_config.hpp"
#include "esi/recon/methods.hpp"

namespace esi {

/// Everything that decides which frames come out of a recording. As JSON:
/// {"method": "esi", "set": {"tau_s": 2.0, ...}, "fps": 100.0, "size": "346x260", ...}
class ReconConfig {
 public:
  ReconConfig();

  ReadOptions read;
  FrameOptions frames;
  StepConfig steps;
  SinkOptions sink;

  const Method& method() const { return *method_; }
  const MethodConfig& method_config() const { return *method_config_; }
  OptionTable& method_options() { return method_config_->options(); }

  /// Chooses a method, with that method's defaults. A name of the table, or the path of a config file.
  void choose_method(const std::string& name_or_file);
  /// "key=value" for an option of the method.
  void set(std::string_view assignment);
  /// Takes a config file's content; `name` is what messages call it.
  void set_json(const nlohmann::json& config, const std::string& name);
  void load(const std::filesystem::path& file);

  nlohmann::json json() const;

  /// The options besides the method's, by group, for flags and --help.
  std::vector<OptionGroup> groups();

 private:
  const Method* method_;
  std::unique_ptr<MethodConfig> method_config_;
};

}  // namespace esi

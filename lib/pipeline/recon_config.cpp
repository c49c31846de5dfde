#include "esi/pipeline/recon_config.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {

ReconConfig::ReconConfig() : method_(&methods().front()), method_config_(method_->configure()) {}

void ReconConfig::choose_method(const std::string& name_or_file) {
  if (name_or_file.ends_with(".json")) return load(name_or_file);
  method_ = &method_named(name_or_file);
  method_config_ = method_->configure();
}

void ReconConfig::set(std::string_view assignment) { method_config_->options().set_assignment(assignment); }

void ReconConfig::load(const std::filesystem::path& file) {
  set_json(parse_json(read_text_file(file), file.string()), file.string());
}

void ReconConfig::set_json(const nlohmann::json& config, const std::string& name) {
  if (!config.is_object()) throw usage_error(name + ": a config is a JSON object of names and values");
  try {
    if (config.contains("method")) {
      if (!config["method"].is_string()) throw usage_error("method: give a name such as \"esi\"");
      method_ = &method_named(config["method"].get<std::string>());
      method_config_ = method_->configure();
    }
    if (config.contains("set")) method_config_->options().set_json(config["set"]);

    OptionTable all;
    read.declare(all);
    frames.declare(all);
    steps.declare(all);
    sink.declare(all);
    for (const auto& [key, value] : config.items()) {
      if (key != "method" && key != "set") all.at(key).set_json(value);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()), error.kind());
  }
}

nlohmann::json ReconConfig::json() const {
  ReconConfig copy_of_plain_options;  // tables bind to non-const fields
  copy_of_plain_options.read = read;
  copy_of_plain_options.frames = frames;
  copy_of_plain_options.steps = steps;
  copy_of_plain_options.sink = sink;
  nlohmann::json config = {{"method", method_->name}, {"set", method_config_->options().json()}};
  for (const OptionGroup& group : copy_of_plain_options.groups()) config.update(group.table.json());
  return config;
}

std::vector<OptionGroup> ReconConfig::groups() {
  return {{"Input", table_of(read)},
          {"Frames", table_of(frames)},
          {"Steps", table_of(steps)},
          {"Output", table_of(sink)}};
}

}  // namespace esi

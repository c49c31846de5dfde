#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "esi/recon/methods.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

/// A method with its defaults. One that needs weights gets a small network of ours (test/models/README.md).
inline std::unique_ptr<MethodConfig> configured(const Method& method) {
  auto config = method.configure();
  Option* const model = config->options().find("model");
  if (model != nullptr) model->set_text((source_dir() / "test/models/tiny_network.onnx").string());
  return config;
}

inline std::unique_ptr<Reconstructor> created(const MethodConfig& config, SensorSize size) {
  return config.create(size, [](const std::string& path) { return content_of(path); });
}

inline bool is_set(MethodConfig& config, std::string_view option, std::string_view value) {
  Option* const found = config.options().find(option);
  return found != nullptr && found->text() == value;
}

/// Runs `check(config, method)` for every method, and again for each of its choices and switches.
template <class CheckBoth>
void for_each_method_variant(CheckBoth check_both) {
  for (const Method& method : methods()) {
    const auto check = [&](MethodConfig& config) { check_both(config, method); };
    INFO("method " << method.name);
    check(*configured(method));
    const auto defaults = configured(method);
    for (const Option& option : defaults->options().options()) {
      const auto value = option.json();
      const auto variant = configured(method);
      if (option.is_switch()) {
        INFO(option.name() << " switched");
        variant->options().at(option.name()).set_json(!value.get<bool>());
        check(*variant);
      } else if (option.domain().find(" | ") != std::string::npos) {
        std::stringstream names(option.domain());
        for (std::string name; names >> name;) {
          if (name == "|") continue;
          INFO(option.name() << "=" << name);
          variant->options().at(option.name()).set_text(name);
          check(*variant);
        }
      }
    }
  }
}

template <class Check>
void for_each_variant(Check check) {
  for_each_method_variant([&check](MethodConfig& config, const Method&) { check(config); });
}

}  // namespace esi::test

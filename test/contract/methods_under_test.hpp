#pragma once

#include <memory>
#include <string>

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

}  // namespace esi::test

#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "esi/io/event_source.hpp"
#include "esi/pipeline/recon_config.hpp"

namespace esi {

/// What a method is made ready for.
struct MethodContext {
  std::filesystem::path recording;
  std::string name;  ///< what messages call the recording
  ReadOptions read;
  const RecordingHeader* header = nullptr;
  SensorSize sensor;             ///< whole
  std::optional<Region> region;  ///< of it, where only a part is reconstructed

  SensorSize size() const { return region ? region->size : sensor; }
};

/// A method with its files and the steps around it, made for one recording.
class ReadyMethod {
 public:
  /// Throws a usage Error where the recording lacks what the method or its frames need, and Errors of the
  /// files that options name; an Error where memory would not suffice.
  ReadyMethod(const ReconConfig& config, const MethodContext& context);
  ~ReadyMethod();

  Reconstructor& reconstructor() { return *reconstructor_; }

  /// What the steps took out so far: for run.json.
  nlohmann::json steps_json() const;
  /// The files that the method read, with their CRC-32: {"model.onnx": "0123abcd"}.
  const nlohmann::json& files_json() const { return *files_; }

 private:
  StepConfig steps_;
  StepSurroundings surroundings_;
  std::unique_ptr<RemovedEvents> removed_;
  std::unique_ptr<nlohmann::json> files_;
  std::unique_ptr<Reconstructor> reconstructor_;
};

}  // namespace esi

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "esi/io/event_digest.hpp"
#include "esi/io/losses.hpp"
#include "esi/pipeline/evaluation/judged_frames.hpp"
#include "esi/pipeline/progress.hpp"

namespace esi {

/// A recording, or a folder of frames that any tool made, with what is known of it.
struct EvalInput {
  std::filesystem::path path;
  std::filesystem::path truth;
  bool is_frames = false;
};

/// What came of one input.
struct InputRun {
  EvalInput input;
  LoadedTruth truth;
  std::optional<EventDigest> digest;  ///< of the events used; none for a folder of frames
  Losses losses;
  SensorSize size;
  double duration_s = 0.0;  ///< of the recording
  std::vector<MethodRun> methods;
};

struct Evaluation {
  std::vector<InputRun> inputs;
  bool stopped = false;  ///< by the observer
};

/// Reconstructs each recording with every method, decoding it once, and judges every frame; frames of folders
/// are only judged, their method is called as the folder. Results don't depend on the number of threads.
/// Throws a usage Error, before any work, for truths, methods and recordings that don't go together.
Evaluation evaluate(const EvalConfig& config, const std::vector<EvalInput>& inputs, int threads,
                    const Observer& observer);

}  // namespace esi

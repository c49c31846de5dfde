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

/// Each input with its truth, and nothing else yet. Throws a usage
/// Error for a truth that can't be, or doesn't go with the options.
std::vector<InputRun> load_inputs(const EvalConfig& config, const std::vector<EvalInput>& inputs);

/// What a folder of frames is called among the methods: its name.
std::string frames_label(const EvalInput& input);

/// Reconstructs each recording with every method, decoding it once, and judges every frame; frames of folders
/// are only judged, those that --start and --end leave. Results don't depend on the number of threads.
/// Throws a usage Error for truths, methods and recordings that don't go together.
Evaluation evaluate(const EvalConfig& config, std::vector<InputRun> inputs, int threads,
                    const Observer& observer);

}  // namespace esi

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "esi/pipeline/evaluation/judged_frames.hpp"

namespace esi {

/// A method's kept frames side by side, tags outlined, as the content of a PNG file; empty where there are
/// none. Phases in order, of each first the detected frame, then the missed one.
std::vector<std::byte> sample_strip(const MethodRun& run);

/// What is to be seen in it: "straight: found at 15.00 s, missed at 14.92 s; ...".
std::string sample_text(const MethodRun& run, const std::vector<Phase>& phases);

}  // namespace esi

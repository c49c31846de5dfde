#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "esi/pipeline/evaluation/results.hpp"

namespace esi {

/// "total>=0.8", or for one method "esi:landing>=0.5": a phase's rate of detected frames that must be
/// reached.
struct Requirement {
  std::string text;  ///< as given
  std::string name;  ///< what stands before ">=": of a phase, or method:phase
  double least = 0.0;
};

/// Throws a usage Error that shows the form.
Requirement parse_requirement(std::string_view text);

/// Throws a usage Error where none of the inputs has such a phase and method.
void require_known(const Requirement& requirement, const std::vector<InputRun>& inputs,
                   const EvalConfig& config);

/// One sentence for each method that misses it: on all inputs together where they could be pooled, else on
/// each input. A phase without frames misses it, too.
std::vector<std::string> missed(const Requirement& requirement, const std::vector<InputResult>& results);

}  // namespace esi

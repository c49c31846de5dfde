#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "esi/pipeline/evaluation/results.hpp"

namespace esi {

/// "total>=0.8", or for one method "esi:landing>=0.5": a phase's rate of detected frames that must be
/// reached.
struct Requirement {
  std::string text;    ///< as given
  std::string method;  ///< empty: every method
  std::string phase;
  double least = 0.0;
};

/// Throws a usage Error that shows the form.
Requirement parse_requirement(std::string_view text);

/// One sentence for each method that misses it, on the first of the results (all inputs together, or the only
/// one); a phase without frames misses it, too. Throws a usage Error where there is no such phase or method.
std::vector<std::string> missed(const Requirement& requirement, const InputResult& result);

}  // namespace esi

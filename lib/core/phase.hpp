#pragma once

#include <string>

#include "esi/core/time.hpp"

namespace esi {

/// A named part of a recording that is scored by itself.
struct Phase {
  std::string name;  ///< any text, also with quotes, commas, line breaks: outputs must escape it
  Interval interval;

  friend bool operator==(const Phase&, const Phase&) = default;
};

}  // namespace esi

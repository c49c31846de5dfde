#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace esi {

/// How far a reconstruction or a simulation is.
struct Progress {
  std::int64_t events = 0;
  std::int64_t frames = 0;
  std::int64_t t_us = 0;           ///< of the recording
  std::optional<double> fraction;  ///< of the recording's bytes, or of what is to be simulated
  std::size_t input = 0;           ///< which one of several
};

/// Is told now and then; returns false to stop early.
using Observer = std::function<bool(const Progress&)>;

}  // namespace esi

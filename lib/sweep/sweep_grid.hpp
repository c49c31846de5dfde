#pragma once

#include <cstddef>
#include <vector>

#include "esi/sweep/sweep_axis.hpp"

namespace esi {

/// Every combination of the axes' values: one cell each. The last axis runs fastest.
class SweepGrid {
 public:
  SweepGrid() = default;
  explicit SweepGrid(std::vector<SweepAxis> axes);

  const std::vector<SweepAxis>& axes() const { return axes_; }
  /// 1 without axes.
  std::size_t cells() const { return cells_; }

  /// The number of each axis' value.
  std::vector<std::size_t> position(std::size_t cell) const;
  std::size_t cell(const std::vector<std::size_t>& position) const;
  /// "tau_s=0.5 n=2"
  std::string text(std::size_t cell) const;

 private:
  std::vector<SweepAxis> axes_;
  std::size_t cells_ = 1;
};

}  // namespace esi

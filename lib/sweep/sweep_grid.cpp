#include "esi/sweep/sweep_grid.hpp"

#include <fmt/format.h>

#include <utility>

namespace esi {

SweepGrid::SweepGrid(std::vector<SweepAxis> axes) : axes_(std::move(axes)) {
  for (const SweepAxis& axis : axes_) cells_ *= axis.values.size();
}

std::vector<std::size_t> SweepGrid::position(std::size_t cell) const {
  std::vector<std::size_t> position(axes_.size());
  for (std::size_t i = axes_.size(); i-- > 0;) {
    position[i] = cell % axes_[i].values.size();
    cell /= axes_[i].values.size();
  }
  return position;
}

std::size_t SweepGrid::cell(const std::vector<std::size_t>& position) const {
  std::size_t cell = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) cell = cell * axes_[i].values.size() + position[i];
  return cell;
}

std::string SweepGrid::text(std::size_t cell) const {
  std::string text;
  const std::vector<std::size_t> values = position(cell);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", axes_[i].option, axes_[i].values[values[i]]);
  }
  return text;
}

}  // namespace esi

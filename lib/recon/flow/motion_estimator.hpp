#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "esi/core/row_team.hpp"
#include "esi/recon/flow/cell_grid.hpp"
#include "esi/recon/flow/common_motion.hpp"

namespace esi {

/// Two images of half the resolution, the first of which moved became the second.
struct MovedPair {
  const cv::Mat1f& before;
  const cv::Mat1f& after;
  float weight;
  float windows;  ///< that passed from the first to the second
};

/// Optical flow by Lucas and Kanade (1981) from several pairs of images at once, on cells that are held
/// together by their neighbours.
class MotionEstimator {
 public:
  struct Options {
    double cell_px;         ///< of the full resolution
    double regularisation;  ///< reg: how much neighbours hold a cell
    double hold;            ///< h: how much a cell's own motion is held, by T's mean
    int rounds;
  };

  MotionEstimator(cv::Size full, const Options& options);

  /// Cells over the half resolution.
  const CellGrid& cells() const { return cells_; }

  /// Improves `field`, from where it stands: first all cells together, equation (2), then, in `rounds`, each,
  ///   v += (T + (reg + h mean T) I)^-1 (rhs + reg (mean of neighbours - v))                     (2a)
  /// where, with m the motion-compensated mean of a pair's images and e their difference,
  ///   T = sum weight grad m grad m^T,  rhs = -sum weight grad m e                                (3)
  /// over a cell, smoothed by [1 2 1] twice, and mean T is half of the mean trace; then by a median of 3x3
  /// cells. No more than 64 px come of it.
  void improve(std::span<const MovedPair> pairs, MotionField& field, const RowTeam& team = kAlone);

  /// Makes the whole field faster or slower, as one of the pairs says alone, v its motion:
  ///   v += s v / 2,   s = sum v . rhs / (1 + sum v . T v)                                          (10)
  /// over all cells, and s / 2 within -0.2 and 0.25. With many pixels there is little noise in s.
  void correct_speed(const MovedPair& pair, MotionField& field, const RowTeam& team = kAlone);

 private:
  struct Compared;
  struct Strip;

  void add_terms_of(std::span<const MovedPair> pairs, const MotionField& field, const RowTeam& team);
  /// Of pixel rows [begin, end), whole rows of cells.
  void add_strip(std::span<const MovedPair> pairs, const MotionField& field, int begin, int end);
  void compensate_row(std::span<const MovedPair> pairs, const MotionField& field, int y, Strip& strip) const;
  void add_row(const MovedPair& pair, const Compared& compared, int y, Strip& strip) const;
  void end_cells(int cell_row, Strip& strip);
  void step(MotionField& field);

  Options options_;
  cv::Size half_;
  CellGrid cells_;
  CellSums sums_;
  std::vector<int> column_cells_;  ///< the cell of each pixel column
  std::vector<int> cell_begins_;   ///< the first pixel row of each row of cells, and the image's height
};

}  // namespace esi

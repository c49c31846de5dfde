#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/core/row_team.hpp"
#include "esi/recon/flow/cell_grid.hpp"
#include "esi/recon/flow/motion_estimator.hpp"

namespace esi {

/// Tells a motion from the opposite one. Of b = -v . grad L a window's events know v L only: where the image
/// moves by much less than a pixel, a start with -v goes on as a negative of the image. Over a longer path
/// events tell: carried along with the right motion they pile up on the edges that made them, carried the
/// other way they smear (the contrast of Gallego, Rebecq, Scaramuzza 2018, between two motions).
class MotionSign {
 public:
  /// For images of this size, half the resolution, and the cells over it.
  MotionSign(cv::Size half, const CellGrid& cells);

  /// Carries on F, along with the motion, and R, against it, and adds a window's events Gb:
  ///   F <- lambda F(x - v) - v Gb,   R <- lambda R(x + v) - v Gb,   lambda = 1 / (1 + |v| / 6 px)    (11)
  void take(const cv::Mat1f& events, const MotionField& field, const RowTeam& team = kAlone);

  /// -1 for cells with the opposite of their motion, 1 for the others; nothing where all are right.
  /// Opposite: at less than 1 px a window, with sums over 5x5 cells,
  ///   |R|^2 - |F|^2 > 0.1 (|R|^2 + |F|^2)                                                           (12)
  /// and neighbours of such cells, as far as |R| > |F|.
  cv::Mat1f signs(const MotionField& field) const;

  /// Says that the motion has been multiplied by these signs.
  void turn(const cv::Mat1f& signs);

 private:
  using Pile = std::array<cv::Mat1f, 2>;  ///< x and y of a vector per pixel

  struct Rows;

  void take_row(const cv::Mat1f& events, const MotionField& field, int y, Rows& rows);
  void sum_cells();

  CellGrid cells_;
  Pile along_, against_;                     ///< F and R
  Pile moved_along_, moved_against_;         ///< of the next window
  cv::Mat1f along_rows_, against_rows_;      ///< energies by row of pixels and column of cells
  cv::Mat1f along_energy_, against_energy_;  ///< by cell
  std::vector<int> column_cells_;
};

}  // namespace esi

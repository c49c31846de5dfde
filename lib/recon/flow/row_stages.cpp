#include "esi/recon/flow/row_stages.hpp"

#include <vector>

namespace esi {
namespace {

/// All stages of rows [begin, end), but for those that need rows beyond a cut.
void make_piece(int begin, int end, int rows, int stages, const StageRow& make_row) {
  for (int first = begin; first < end + stages - 1; ++first) {
    for (int k = 0; k < stages; ++k) {
      const int y = first - k;
      const int lowest = begin == 0 ? 0 : begin + k;
      const int end_of_stage = end == rows ? rows : end - k;
      if (y >= lowest && y < end_of_stage) make_row(k, y);
    }
  }
}

/// What the pieces on both sides of a cut have left.
void make_seam(int cut, int stages, const StageRow& make_row) {
  for (int k = 1; k < stages; ++k) {
    for (int y = cut - k; y < cut + k; ++y) make_row(k, y);
  }
}

}  // namespace

void over_stages(const RowTeam& team, cv::Size image, int stages, const std::function<StageRow()>& piece,
                 const std::function<StageRow()>& seam) {
  const std::vector<int> cuts = team.cuts(image.height, image.width, 2 * stages);
  const auto cut = [&cuts](int i) { return cuts[static_cast<std::size_t>(i)]; };
  const int pieces = static_cast<int>(cuts.size()) - 1;
  team.each(pieces, [&](int i) { make_piece(cut(i), cut(i + 1), image.height, stages, piece()); });
  team.each(pieces - 1, [&](int i) { make_seam(cut(i + 1), stages, seam()); });
}

}  // namespace esi

#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>
#include <vector>

#include "esi/core/worker_pool.hpp"

namespace esi {

/// Threads that go over an image's rows together: the one that calls, and those of a pool's workers that have
/// nothing else to do. Who takes which rows is chance, and where they are cut depends on the pool: results
/// must not. So a row's result comes from what was there before, and sums are taken row by row, to be added
/// in the rows' order afterwards.
class RowTeam {
 public:
  /// The pool belongs to the thread that makes all calls here. Before this one, that thread is alone.
  void use(std::shared_ptr<WorkerPool> workers) { workers_ = std::move(workers); }

  /// While it lives, idle workers look out for rows and don't sleep: waking them would take longer than many
  /// a pass over an image.
  class Shift {
   public:
    explicit Shift(RowTeam* team) : team_(team) {}
    ~Shift();
    Shift(const Shift&) = delete;
    Shift& operator=(const Shift&) = delete;

   private:
    RowTeam* team_;
  };

  /// One within another makes no difference.
  [[nodiscard]] Shift begin_shift();

  /// Calls work(i), which makes no calls here itself, once for each i from 0 to count - 1, in any order,
  /// within a shift on any thread. Rethrows the error of one of them when none runs any more.
  void each(int count, const std::function<void(int i)>& work) const;

  /// Where to cut so many rows: 0, multiples of `step`, and `rows`. Pieces have at least `step` rows, and
  /// enough pixels to be worth it.
  std::vector<int> cuts(int rows, int row_pixels, int step) const;

  /// Calls work(begin, end) for an image's rows [begin, end), piece by piece.
  void over_rows(cv::Size image, const std::function<void(int begin, int end)>& work) const;

 private:
  class Job;
  struct Board;

  std::shared_ptr<WorkerPool> workers_;
  std::shared_ptr<Board> board_;  ///< within a shift
};

/// The calling thread, and no other.
inline const RowTeam kAlone;

}  // namespace esi

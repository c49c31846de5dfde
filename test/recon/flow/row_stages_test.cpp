#include "esi/recon/flow/row_stages.hpp"

#include <catch2/catch.hpp>
#include <mutex>
#include <opencv2/core.hpp>

using namespace esi;

namespace {

/// Notes which rows of which stages are there, and whether what they need was there before them.
class Progress {
 public:
  Progress(int stages, int rows) : made_(stages, rows, std::uint8_t{0}) {}

  void make(int k, int y) {
    const std::lock_guard lock(mutex_);
    for (int near = std::max(y - 1, 0); k > 0 && near < std::min(y + 2, made_.cols); ++near)
      is_in_order_ &= made_(k - 1, near) == 1;
    ++made_(k, y);
  }

  bool is_in_order() const { return is_in_order_; }
  bool is_complete() const { return cv::countNonZero(made_ != 1) == 0; }

 private:
  cv::Mat1b made_;
  bool is_in_order_ = true;
  std::mutex mutex_;
};

}  // namespace

TEST_CASE("each row of each stage is made once, after those that it needs") {
  for (const int workers : {0, 1, 2, 6}) {
    RowTeam team;
    team.use(std::make_shared<WorkerPool>(workers));
    const auto shift = team.begin_shift();
    for (const cv::Size size :
         {cv::Size(346, 260), cv::Size(20000, 14), cv::Size(20000, 1), cv::Size(9, 5)}) {
      for (const int stages : {1, 2, 5, 7}) {
        INFO(workers << " workers, " << size.height << " rows, " << stages << " stages");
        Progress progress(stages, size.height);
        bool is_seam_late = true;
        over_stages(
            team, size, stages, [&] { return [&](int k, int y) { progress.make(k, y); }; },
            [&] {
              return [&](int k, int y) {
                if (k == 0) is_seam_late = false;
                progress.make(k, y);
              };
            });
        CHECK(is_seam_late);
        CHECK(progress.is_in_order());
        CHECK(progress.is_complete());
      }
    }
  }
}

#include "esi/core/row_team.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>

namespace esi {
namespace {

/// Of a piece: some microseconds' work, of which handing it over takes one.
constexpr int kLeastPixels = 2048;
/// More than one, since workers come when they have time.
constexpr int kPiecesPerThread = 2;

/// For what is a matter of microseconds, mostly: on a busy machine whoever yields loses milliseconds.
class ShortWait {
 public:
  void go_on() {
    if (turns_ == kTurns) return std::this_thread::yield();
    ++turns_;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }

 private:
  static constexpr int kTurns = 4000;  // about 100 us
  int turns_ = 0;
};

}  // namespace

class RowTeam::Job {
 public:
  Job(int count, const std::function<void(int)>& work) : count_(count), work_(work) {}

  void run() {
    try {
      for (int i = next_++; i < count_; i = next_++) work_(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      error_ = std::current_exception();
    }
  }

  /// Once all have left it.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const int count_;
  const std::function<void(int)>& work_;
  std::atomic<int> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
};

/// Where workers look what there is to do. They come and go as they like: a job is taken down before anybody
/// asks whether they have left it.
struct RowTeam::Board {
  std::atomic<bool> is_open = true;
  std::atomic<Job*> job = nullptr;
  std::atomic<int> helpers = 0;

  void help() {
    ShortWait wait;
    while (is_open) {
      if (job == nullptr) {
        wait.go_on();
        continue;
      }
      ++helpers;
      if (Job* const found = job) found->run();
      --helpers;
      wait = {};
    }
  }
};

RowTeam::Shift RowTeam::begin_shift() {
  if (!workers_ || workers_->workers() == 0 || board_) return Shift(nullptr);
  auto board = std::make_shared<Board>();
  try {
    for (std::size_t i = 0; i < workers_->workers(); ++i) workers_->submit([board] { board->help(); });
  } catch (...) {
    board->is_open = false;
    throw;
  }
  board_ = std::move(board);
  return Shift(this);
}

RowTeam::Shift::~Shift() {
  if (team_ == nullptr) return;
  team_->board_->is_open = false;
  team_->board_.reset();
}

void RowTeam::each(int count, const std::function<void(int)>& work) const {
  Job job(count, work);
  if (board_ && count > 1) board_->job = &job;
  job.run();
  if (board_) {
    board_->job = nullptr;
    for (ShortWait wait; board_->helpers != 0;) wait.go_on();
  }
  job.rethrow();
}

std::vector<int> RowTeam::cuts(int rows, int row_pixels, int step) const {
  int pieces = 1;
  if (board_) {
    const auto threads = static_cast<std::int64_t>(workers_->workers()) + 1;
    const auto pixels = static_cast<std::int64_t>(rows) * row_pixels;
    pieces = static_cast<int>(std::min(
        {kPiecesPerThread * threads, pixels / kLeastPixels, static_cast<std::int64_t>(rows / step)}));
  }
  std::vector<int> cuts{0};
  for (int i = 1; i < pieces; ++i) cuts.push_back(i * rows / pieces / step * step);
  cuts.push_back(rows);
  return cuts;
}

void RowTeam::over_rows(cv::Size image, const std::function<void(int begin, int end)>& work) const {
  const std::vector<int> cut = cuts(image.height, image.width, 1);
  each(static_cast<int>(cut.size()) - 1, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    work(cut[at], cut[at + 1]);
  });
}

}  // namespace esi

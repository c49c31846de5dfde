#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace esi::cli {

/// A line on a terminal that is rewritten about ten times a second. Elsewhere it says nothing.
class ProgressBar {
 public:
  /// `wanted` is false with --quiet; a stderr that is no terminal, or TERM=dumb, has none either.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Counts, times and speeds begin anew: the next of several recordings.
  void restart();

  /// `t_us` is the recording's time so far, `fraction` how much of it has been read. No events are not told.
  void show(std::int64_t events, std::int64_t frames, std::int64_t t_us, std::optional<double> fraction);

  /// So many of all things of a kind are done.
  void show_share(const char* kind, std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due();
  double elapsed_s() const;
  void print(std::string line, std::optional<double> fraction) const;

  bool is_shown_;
  Clock::time_point started_ = Clock::now();
  Clock::time_point next_ = started_;
  std::optional<std::int64_t> t_begin_us_;
};

}  // namespace esi::cli

#include "progress_bar.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace esi::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRefresh{100};

bool is_capable_terminal() {
  const char* const term = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

/// A longer line would wrap, and only its last part could be rewritten.
std::size_t terminal_columns() {
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_known ? size.ws_col : 80;
}

std::string counts(std::int64_t events, std::int64_t frames, double elapsed_s) {
  if (events == 0) return fmt::format("{} frames", frames);
  const double mev = static_cast<double>(events) * 1e-6;
  return fmt::format("{:.1f} Mev, {} frames, {:.1f} Mev/s", mev, frames, mev / elapsed_s);
}

std::string bar(double fraction) {
  const auto full = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * kBarWidth);
  return "[" + std::string(full, '#') + std::string(kBarWidth - full, '.') + "] ";
}

}  // namespace

ProgressBar::ProgressBar(bool wanted) : is_shown_(wanted && is_capable_terminal()) {}

ProgressBar::~ProgressBar() {
  if (is_shown_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::restart() {
  started_ = Clock::now();
  t_begin_us_.reset();
}

void ProgressBar::show(std::int64_t events, std::int64_t frames, std::int64_t t_us,
                       std::optional<double> fraction) {
  if (!t_begin_us_) t_begin_us_ = t_us;
  if (!is_due()) return;
  const double recording_s = static_cast<double>(t_us - *t_begin_us_) * 1e-6;
  print(fmt::format("{}, {:.1f} x real time", counts(events, frames, elapsed_s()), recording_s / elapsed_s()),
        fraction);
}

void ProgressBar::show_share(const char* kind, std::size_t done, std::size_t all) {
  if (all == 0 || !is_due()) return;
  print(fmt::format("{} of {} {}", done, all, kind), static_cast<double>(done) / static_cast<double>(all));
}

bool ProgressBar::is_due() {
  const auto now = Clock::now();
  if (!is_shown_ || now < next_) return false;
  next_ = now + kRefresh;
  return true;
}

double ProgressBar::elapsed_s() const {
  return std::max(1e-3, std::chrono::duration<double>(Clock::now() - started_).count());
}

void ProgressBar::print(std::string line, std::optional<double> fraction) const {
  if (fraction) line = bar(*fraction) + line;
  if (fraction && *fraction > 0.01) {
    line += fmt::format(", {:.0f} s left", elapsed_s() / *fraction * (1.0 - *fraction));
  }
  line.resize(std::min(line.size(), terminal_columns() - 1));
  fmt::print(stderr, "\r\x1b[K{}", line);
  std::fflush(stderr);
}

}  // namespace esi::cli

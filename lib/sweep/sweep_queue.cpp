#include "esi/sweep/sweep_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "esi/core/error.hpp"

namespace esi {

SweepShard parse_shard(const std::string& text) {
  SweepShard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = error == std::errc{} && slash != end && *slash == '/';
  const auto [stop, other] = has_slash ? std::from_chars(slash + 1, end, shard.count)
                                       : std::from_chars_result{slash, std::errc::invalid_argument};
  const bool is_one = other == std::errc{} && stop == end && shard.index >= 1 && shard.index <= shard.count;
  if (is_one) return shard;
  throw usage_error(fmt::format("--shard {}: give I/N such as 2/3, the second of three parts", text));
}

std::string to_string(const SweepShard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

SweepQueue::SweepQueue(SweepStore& store, const SweepHeader& header, SweepShard shard, BlockLimits limits)
    : store_(store),
      header_(header),
      shard_(shard),
      limits_(limits),
      search_(header.config.search, header.config.score.bootstrap, header.config.judging.stride),
      ledger_(header.config.grid().cells(), header.recordings),
      cells_(header.config.grid().cells()),
      waiting_(header.recordings.size()) {
  std::iota(cells_.begin(), cells_.end(), std::size_t{0});
  std::erase_if(cells_, [&](std::size_t cell) { return !shard_.has(cell); });
  begin_round();
}

void SweepQueue::begin_round() {
  for (const CellRecord& record : store_.records()) {
    if (record.round == round_) ledger_.add(record);
  }
  for (std::size_t recording = 0; recording < waiting_.size(); ++recording) {
    for (const std::size_t cell : cells_) {
      ++known_;
      if (store_.has(cell, recording, round_)) {
        ++done_;
      } else {
        waiting_[recording].push_back(cell);
      }
    }
  }
  seconds_per_cell_second_ = 0.0;  // other frames take other times
}

/// To the next round that has anything to do. False at the end.
bool SweepQueue::advance() {
  if (round_ + 1 >= search_.rounds()) return false;
  cells_ = search_.survivors(ledger_, cells_, round_, header_.config.grid().cells());
  ++round_;
  begin_round();
  return true;
}

SweepTurn SweepQueue::take_turn() {
  while (!is_stopped_ && !is_complete_) {
    for (std::size_t recording = 0; recording < waiting_.size(); ++recording) {
      std::deque<std::size_t>& cells = waiting_[recording];
      if (cells.empty()) continue;
      SweepBlock block{recording, round_, search_.frames(round_), {}};
      const auto end = cells.begin() + static_cast<std::ptrdiff_t>(block_cells(recording));
      block.cells.assign(cells.begin(), end);
      cells.erase(cells.begin(), end);
      ++in_progress_;
      return {block, false};
    }
    if (in_progress_ > 0) return {};
    if (!advance()) is_complete_ = true;
  }
  changed_.notify_all();
  return {std::nullopt, true};
}

std::optional<SweepBlock> SweepQueue::next() {
  std::unique_lock lock(mutex_);
  for (;;) {
    SweepTurn turn = take_turn();
    if (turn.block || turn.has_ended) return std::move(turn.block);
    changed_.wait(lock);
  }
}

SweepTurn SweepQueue::try_next() {
  const std::lock_guard lock(mutex_);
  return take_turn();
}

std::size_t SweepQueue::block_cells(std::size_t recording) const {
  const std::size_t waiting = waiting_[recording].size();
  const double cell_s = seconds_per_cell_second_ * header_.recordings[recording].duration_s;
  const double fitting = cell_s > 0.0 ? std::floor(limits_.seconds / cell_s) : 1.0;
  const std::size_t fair = (waiting + limits_.workers - 1) / limits_.workers;
  const double most = static_cast<double>(std::min({waiting, fair, limits_.most_cells}));
  return static_cast<std::size_t>(std::clamp(fitting, 1.0, most));
}

void SweepQueue::finish(const SweepBlock& block, std::vector<CellRecord> records, double seconds) {
  const std::lock_guard lock(mutex_);
  const double duration_s = header_.recordings[block.recording].duration_s;
  if (block.round == round_ && duration_s > 0.0) {
    seconds_per_cell_second_ = seconds / (static_cast<double>(block.cells.size()) * duration_s);
  }
  for (const CellRecord& record : records) ledger_.add(record);
  done_ += records.size();
  store_.add(std::move(records));
  --in_progress_;
  changed_.notify_all();
}

void SweepQueue::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  changed_.notify_all();
}

bool SweepQueue::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return is_stopped_;
}

bool SweepQueue::is_complete() const {
  const std::lock_guard lock(mutex_);
  return is_complete_;
}

bool SweepQueue::wait_for_end(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [this] { return is_stopped_ || is_complete_; });
}

std::pair<std::size_t, std::size_t> SweepQueue::progress() const {
  const std::lock_guard lock(mutex_);
  return {done_, known_};
}

}  // namespace esi

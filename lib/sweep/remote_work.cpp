#include "esi/sweep/remote_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/sweep/block_json.hpp"

namespace esi {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kStatePeriod{1000};
/// Where a round of the search has to end first, which takes up to a block's minute.
constexpr milliseconds kFirstPause{10}, kLongestPause{1000};

}  // namespace

RemoteWork::RemoteWork(SweepTeam& team, const SweepHeader& header) : team_(team) {
  const nlohmann::json reply = ask({{"ask", "join"}, {"sweep", to_json(header)}});
  if (!reply.contains("why")) return;
  throw Error(fmt::format("the team's leader has another sweep ({}); give all machines the same files",
                          reply["why"].get<std::string>()));
}

std::optional<SweepBlock> RemoteWork::next() {
  milliseconds pause = kFirstPause;
  while (!has_ended_) {
    const nlohmann::json reply = ask({{"ask", "next"}});
    if (reply.contains("block")) return block_from(reply["block"]);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, pause, [this] { return has_ended_.load(); });
    pause = std::min(2 * pause, kLongestPause);
  }
  return std::nullopt;
}

void RemoteWork::finish(const SweepBlock& block, std::vector<CellRecord> records, double seconds) {
  nlohmann::json question = {{"ask", "finish"},
                             {"block", to_json(block)},
                             {"seconds", seconds},
                             {"records", nlohmann::json::array()}};
  for (const CellRecord& record : records) question["records"].push_back(to_json(record));
  ask(question);
}

void RemoteWork::stop() {
  if (!has_ended_) ask({{"ask", "stop"}});
}

bool RemoteWork::wait_for_end(milliseconds longest) {
  if (Clock::now() - asked_ >= kStatePeriod) {
    asked_ = Clock::now();
    if (!has_ended_) ask({{"ask", "state"}});
  }
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [this] { return has_ended_.load(); });
}

nlohmann::json RemoteWork::ask(const nlohmann::json& question) {
  nlohmann::json reply = nlohmann::json::parse(team_.ask(question.dump()));
  if (reply.value("end", false)) end();
  return reply;
}

void RemoteWork::end() {
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  changed_.notify_all();
}

}  // namespace esi

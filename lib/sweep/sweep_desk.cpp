#include "esi/sweep/sweep_desk.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "esi/sweep/block_json.hpp"

namespace esi {

std::string SweepDesk::answer(const std::string& question) {
  try {
    return reply_to(nlohmann::json::parse(question)).dump();
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
    queue_.stop();
    return R"({"end": true})";
  }
}

nlohmann::json SweepDesk::reply_to(const nlohmann::json& question) {
  const auto what = question.at("ask").get<std::string>();
  if (what == "join") return welcome(question.at("sweep"));
  if (what == "next") {
    const SweepTurn turn = queue_.try_next();
    return turn.block ? nlohmann::json{{"block", to_json(*turn.block)}}
                      : nlohmann::json{{"end", turn.has_ended}};
  }
  if (what == "finish") take_records(question);
  if (what == "stop") queue_.stop();
  return {{"end", queue_.is_stopped() || queue_.is_complete()}};
}

nlohmann::json SweepDesk::welcome(const nlohmann::json& sweep) {
  const std::string what = difference(to_json(header_), sweep);
  if (what.empty()) return {{"end", false}};
  queue_.stop();
  return {{"end", true}, {"why", what}};
}

void SweepDesk::take_records(const nlohmann::json& question) {
  const SweepBlock block = block_from(question.at("block"));
  std::vector<CellRecord> records;
  for (const auto& record : question.at("records")) {
    records.push_back(record_from(record, header_.recordings.at(block.recording).phases));
  }
  queue_.finish(block, std::move(records), question.at("seconds").get<double>());
}

}  // namespace esi

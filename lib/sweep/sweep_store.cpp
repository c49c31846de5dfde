#include "esi/sweep/sweep_store.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"

namespace esi {
namespace {

constexpr const char* kSum = "line_crc32";

/// With a sum over all else, so that no damage is taken for a result.
std::string line_of(nlohmann::json object) {
  object[kSum] = crc32_of(object.dump());
  return object.dump();
}

nlohmann::json object_in(const std::string& line) {
  nlohmann::json object = nlohmann::json::parse(line);
  if (!object.is_object() || !object.contains(kSum)) throw Error("is no line of a store");
  const nlohmann::json sum = object[kSum];
  object.erase(kSum);
  if (sum != crc32_of(object.dump())) throw Error("its sum is wrong");
  return object;
}

void refuse_other_sweep(const nlohmann::json& there, const nlohmann::json& wanted,
                        const std::filesystem::path& path) {
  const auto shard_in = [](const nlohmann::json& header) { return header.value("shard", "no shard"); };
  const std::string what = shard_in(there) == shard_in(wanted)
                               ? difference(there, wanted)
                               : fmt::format("shard was {} and is {}", shard_in(there), shard_in(wanted));
  if (what.empty()) return;
  throw usage_error(
      fmt::format("{}: holds the cells of another sweep ({}); choose another folder, or take this one away",
                  path.string(), what));
}

/// Throws an Error for a record that can't be one of this sweep.
CellRecord checked_record(const nlohmann::json& json, const SweepHeader& header, std::size_t cells) {
  const auto recording = json.at("recording").get<std::size_t>();
  if (recording >= header.recordings.size()) throw Error("there is no such recording");
  CellRecord record = record_from(json, header.recordings[recording].phases);
  if (record.cell >= cells) throw Error("there is no such cell");
  return record;
}

}  // namespace

StoreContent parse_store(const std::vector<std::string>& lines, const std::filesystem::path& path) {
  StoreContent content;
  std::size_t line = 0;  // before the one that is read
  try {
    if (lines.empty()) return content;
    content.header = object_in(lines[line]);
    const SweepHeader header = header_from(content.header);
    const std::size_t cells = header.config.grid().cells();
    for (++line; line < lines.size(); ++line) {
      content.records.push_back(checked_record(object_in(lines[line]), header, cells));
    }
    return content;
  } catch (const std::exception& error) {  // of JSON or ours
    throw Error(fmt::format("{}, line {}: {}; the file is damaged, take it away to begin anew", path.string(),
                            line + 1, error.what()));
  }
}

StoreContent read_store(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kStoreName;
  StoreContent content = parse_store(read_journal(path), path);
  if (content.header.is_null()) throw Error(path.string() + ": is empty; no sweep has got that far");
  return content;
}

SweepStore::SweepStore(const std::filesystem::path& folder, const nlohmann::json& header)
    : path_(folder / kStoreName), journal_(path_, folder.string()) {
  StoreContent content = parse_store(journal_.lines(), path_);
  if (content.header.is_null()) {
    journal_.append(line_of(header));
  } else {
    refuse_other_sweep(content.header, header, path_);
  }
  header_ = content.header.is_null() ? header : std::move(content.header);
  for (CellRecord& record : content.records) {
    if (known_.insert({record.cell, record.recording, record.round}).second) {
      records_.push_back(std::move(record));
    }
  }
}

void SweepStore::add(std::vector<CellRecord> records) {
  std::string lines;
  for (CellRecord& record : records) {
    if (!known_.insert({record.cell, record.recording, record.round}).second) continue;
    lines += (lines.empty() ? "" : "\n") + line_of(to_json(record));
    records_.push_back(std::move(record));
  }
  if (!lines.empty()) journal_.append(lines);
}

}  // namespace esi

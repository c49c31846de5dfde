#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "esi/io/output/journal_file.hpp"
#include "esi/sweep/cell_record.hpp"
#include "esi/sweep/sweep_header.hpp"

namespace esi {

inline constexpr const char* kStoreName = "cells.jsonl";

/// What a store holds.
struct StoreContent {
  nlohmann::json header;
  std::vector<CellRecord> records;
};

/// Throws an Error "FILE, line N: ..." for a line that is no record; `header` null where the file is empty.
StoreContent parse_store(const std::vector<std::string>& lines, const std::filesystem::path& path);

/// Reads the store in a folder. Throws an Error where there is none.
StoreContent read_store(const std::filesystem::path& folder);

/// The finished cells of a sweep, on the disk: a header and a line for each cell, recording and round. Made
/// so that a run that was killed goes on where it was.
class SweepStore {
 public:
  /// Opens the folder's store or makes it. Throws a usage Error where it belongs to another sweep, and an
  /// Error where another run holds it or where a line in it is damaged.
  SweepStore(const std::filesystem::path& folder, const nlohmann::json& header);

  /// Of the run that made the store: its recordings are called what they were called then.
  SweepHeader header() const { return header_from(header_); }
  const std::vector<CellRecord>& records() const { return records_; }
  bool has(std::size_t cell, std::size_t recording, std::int64_t round) const {
    return known_.contains({cell, recording, round});
  }
  void add(std::vector<CellRecord> records);

 private:
  std::filesystem::path path_;
  JournalFile journal_;
  nlohmann::json header_;
  std::vector<CellRecord> records_;
  std::set<std::tuple<std::size_t, std::size_t, std::int64_t>> known_;
};

}  // namespace esi

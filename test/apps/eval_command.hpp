#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_tool.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

inline std::string eval() { return quoted(tool("esi-eval")); }

/// 3 s with two tags, corners and poses; 128x96 px, which the truth's camera says.
inline std::filesystem::path flight() { return source_dir() / "data-samples/flight/events.h5"; }
/// Its first 0.2 s, with intensity frames.
inline std::filesystem::path flight_start() {
  return source_dir() / "data-samples/flight-start/events.aedat4";
}

inline ToolResult evaluate(const std::filesystem::path& out, const std::string& arguments) {
  return run_shell(eval() + " --quiet -o " + quoted(out) + " " + arguments);
}

inline nlohmann::json report_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(content_of(folder / "report.json"));
}

/// Rows of a csv file (RFC 4180), each by column name.
inline std::vector<std::map<std::string, std::string>> csv_rows(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool is_quoted = false;
  for (const char c : content_of(file)) {
    if (c == '"') {
      is_quoted = !is_quoted;
      if (is_quoted && !lines.back().back().empty()) lines.back().back() += '"';
    } else if (c == ',' && !is_quoted) {
      lines.back().emplace_back();
    } else if (c == '\n' && !is_quoted) {
      lines.push_back({""});
    } else {
      lines.back().back() += c;
    }
  }
  lines.pop_back();
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].size() != lines[0].size()) throw std::runtime_error(file.string() + ": a row is too short");
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < lines[i].size(); ++k) row[lines[0][k]] = lines[i][k];
  }
  return rows;
}

}  // namespace esi::test

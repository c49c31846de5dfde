#pragma once

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "apps/eval_command.hpp"

// A count of its own over what esi-eval writes, from detections.csv and the truth.

namespace esi::test {

using Row = std::map<std::string, std::string>;

/// Four corners a tag has in corners.csv at exactly that time; nothing where it has no row.
using Truth = std::map<std::pair<std::int64_t, std::string>, std::array<double, 8>>;

inline Truth true_corners(const std::filesystem::path& file) {
  Truth truth;
  for (const Row& row : csv_rows(file)) {
    auto& corners = truth[{std::llround(1e6 * std::stod(row.at("t_s"))), row.at("id")}];
    for (std::size_t k = 0; k < 8; ++k) {
      corners[k] = std::stod(row.at((k % 2 == 0 ? "x" : "y") + std::to_string(k / 2 + 1)));
    }
  }
  return truth;
}

/// Whether all four corners lie within 5 px of the truth, in any of the four rotations.
inline bool is_in_place(const Row& row, const std::array<double, 8>& truth) {
  for (std::size_t turn = 0; turn < 4; ++turn) {
    double farthest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t other = 2 * ((k + turn) % 4);
      const std::string n = std::to_string(k + 1);
      farthest = std::max(farthest, std::hypot(std::stod(row.at("x" + n)) - truth[other],
                                               std::stod(row.at("y" + n)) - truth[other + 1]));
    }
    if (farthest <= 5.0) return true;
  }
  return false;
}

struct Counts {
  int frames = 0, detected = 0, wrong = 0;
  bool operator==(const Counts&) const = default;
};
using CountsByPhase = std::map<std::array<std::string, 3>, Counts>;

/// Frames by the truth's phases, detections by its corners.
inline CountsByPhase counted(const std::filesystem::path& out, const std::filesystem::path& flight_folder) {
  const nlohmann::json phases =
      nlohmann::json::parse(content_of(flight_folder / "ground_truth.json"))["phases"];
  const Truth truth = true_corners(flight_folder / "corners.csv");
  const auto phase_at = [&](std::int64_t t_us) -> std::string {
    for (const nlohmann::json& phase : phases) {
      const auto t_s = 1e-6 * static_cast<double>(t_us);
      if (phase["start_s"] <= t_s && t_s < phase["end_s"].get<double>()) return phase["name"];
    }
    return {};
  };
  std::set<std::array<std::string, 3>> found;
  CountsByPhase counts;
  for (const Row& row : csv_rows(out / "detections.csv")) {
    const std::int64_t t_us = std::stoll(row.at("t_us"));
    const std::string phase = phase_at(t_us);
    if (phase.empty()) continue;
    const auto corners = truth.find({t_us, row.at("id")});
    if (corners != truth.end() && is_in_place(row, corners->second)) {
      found.insert({row.at("input"), row.at("method"), row.at("frame")});
    } else {
      ++counts[{row.at("input"), row.at("method"), phase}].wrong;
    }
  }
  for (const Row& row : csv_rows(out / "frames.csv")) {
    const std::string phase = phase_at(std::stoll(row.at("t_us")));
    const bool is_found = found.count({row.at("input"), row.at("method"), row.at("frame")}) > 0;
    CHECK(row.at("phase") == phase);
    CHECK(row.at("detected") == (is_found && !phase.empty() ? "1" : "0"));
    if (phase.empty()) continue;
    Counts& count = counts[{row.at("input"), row.at("method"), phase}];
    ++count.frames;
    count.detected += is_found ? 1 : 0;
  }
  return counts;
}

}  // namespace esi::test

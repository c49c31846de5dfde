#include "esi/sweep/cell_record.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

std::string hex_of(const std::vector<FrameScore>& frames) {
  std::string hex((frames.size() + 3) / 4, '0');
  std::vector<unsigned> digits(hex.size(), 0U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].is_detected) digits[i / 4] |= 8U >> (i % 4);
  }
  std::transform(digits.begin(), digits.end(), hex.begin(), [](unsigned digit) { return kHexDigits[digit]; });
  return hex;
}

std::vector<bool> bits_from(const std::string& hex, std::size_t count) {
  if (hex.size() != (count + 3) / 4) throw Error("\"detected\" does not have a bit for each frame");
  std::vector<bool> bits(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t digit = kHexDigits.find(hex[i / 4]);
    if (digit == std::string_view::npos) throw Error("\"detected\" is not hexadecimal");
    bits[i] = ((digit >> (3 - i % 4)) & 1U) != 0;
  }
  return bits;
}

/// The spacing of frames that are evenly spaced, else 0.
std::int64_t spacing_us(const std::vector<FrameScore>& frames) {
  if (frames.size() < 2) return 1;
  const std::int64_t spacing = frames[1].t_us - frames[0].t_us;
  for (std::size_t i = 2; i < frames.size(); ++i) {
    if (frames[i].t_us - frames[i - 1].t_us != spacing) return 0;
  }
  return spacing;
}

void put_times(nlohmann::json& json, const std::vector<FrameScore>& frames) {
  json["frames"] = frames.size();
  if (frames.empty()) return;
  if (const std::int64_t spacing = spacing_us(frames); spacing > 0) {
    json["first_us"] = frames.front().t_us;
    json["every_us"] = spacing;
    return;
  }
  json["times_us"] = nlohmann::json::array();
  for (const FrameScore& frame : frames) json["times_us"].push_back(frame.t_us);
}

std::vector<std::int64_t> times_from(const nlohmann::json& json) {
  const auto count = json.at("frames").get<std::size_t>();
  if (count == 0) return {};
  if (json.contains("times_us")) {
    auto times = json["times_us"].get<std::vector<std::int64_t>>();
    if (times.size() != count) throw Error("\"times_us\" does not have a time for each frame");
    return times;
  }
  // A count that no line can have had is not worth its memory.
  if (json.at("detected").get_ref<const std::string&>().size() != (count + 3) / 4) {
    throw Error("\"detected\" does not have a bit for each frame");
  }
  std::vector<std::int64_t> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    times[i] = json.at("first_us").get<std::int64_t>() +
               static_cast<std::int64_t>(i) * json.at("every_us").get<std::int64_t>();
  }
  return times;
}

std::size_t phase_at(const std::vector<Phase>& phases, std::int64_t t_us) {
  const auto has_time = [&](const Phase& phase) { return phase.interval.contains(t_us); };
  const auto found = std::find_if(phases.begin(), phases.end(), has_time);
  if (found == phases.end()) throw Error("a frame lies in none of the phases");
  return static_cast<std::size_t>(found - phases.begin());
}

CellRecord read_record(const nlohmann::json& json, const std::vector<Phase>& phases) {
  CellRecord record;
  record.cell = json.at("cell").get<std::size_t>();
  record.recording = json.at("recording").get<std::size_t>();
  record.round = json.at("round").get<std::int64_t>();
  const std::vector<std::int64_t> times = times_from(json);
  const std::vector<bool> bits = bits_from(json.at("detected").get<std::string>(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    record.frames.push_back({times[i], phase_at(phases, times[i]), bits[i]});
  }
  for (const auto& phase : json.at("phases")) {
    record.phases.push_back({phase.at("wrong").get<std::int64_t>(), phase.at("corners").get<std::int64_t>(),
                             phase.at("corner_error_px").get<double>()});
  }
  if (record.phases.size() != phases.size()) throw Error("the truth has another number of phases");
  return record;
}

}  // namespace

CellRecord cell_record(std::size_t cell, std::size_t recording, std::int64_t round, const Score& score) {
  CellRecord record{cell, recording, round, score.frames, {}};
  for (const PhaseScore& phase : score.phases) {
    PhaseRecord& own = record.phases.emplace_back();
    own.wrong = phase.wrong.total();
    if (!phase.tags.corner_error_mean_px) continue;
    own.corners = phase.tags.instances.hits - phase.tags.unverified;
    own.corner_error_px = *phase.tags.corner_error_mean_px;
  }
  return record;
}

nlohmann::json to_json(const CellRecord& record) {
  nlohmann::json json = {{"cell", record.cell},
                         {"recording", record.recording},
                         {"round", record.round},
                         {"detected", hex_of(record.frames)},
                         {"phases", nlohmann::json::array()}};
  put_times(json, record.frames);
  for (const PhaseRecord& phase : record.phases) {
    json["phases"].push_back(
        {{"wrong", phase.wrong}, {"corners", phase.corners}, {"corner_error_px", phase.corner_error_px}});
  }
  return json;
}

CellRecord record_from(const nlohmann::json& json, const std::vector<Phase>& phases) {
  try {
    return read_record(json, phases);
  } catch (const nlohmann::json::exception& error) {
    throw Error(error.what());
  }
}

}  // namespace esi

#include "esi/sweep/sweep_header.hpp"

#include <fmt/format.h>

#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/version.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

constexpr const char* kStoreForm = "esi-sweep 1";
/// Weights of networks are the largest files that options name.
constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;

nlohmann::json to_json(const SweptRecording& recording) {
  nlohmann::json json = {{"path", recording.path},
                         {"ground_truth", recording.truth_path},
                         {"events", recording.events},
                         {"crc32", recording.crc32},
                         {"ground_truth_crc32", recording.truth_crc32},
                         {"duration_s", recording.duration_s},
                         {"width", recording.size.width_px},
                         {"height", recording.size.height_px},
                         {"lost", recording.lost},
                         {"phases", nlohmann::json::array()}};
  for (const Phase& phase : recording.phases) {
    json["phases"].push_back(
        {{"name", phase.name}, {"begin_us", phase.interval.begin_us}, {"end_us", phase.interval.end_us}});
  }
  return json;
}

SweptRecording recording_from(const nlohmann::json& json) {
  SweptRecording recording{json.at("path").get<std::string>(),
                           json.at("ground_truth").get<std::string>(),
                           json.at("events").get<std::int64_t>(),
                           json.at("crc32").get<std::string>(),
                           json.at("ground_truth_crc32").get<std::string>(),
                           json.at("duration_s").get<double>(),
                           {},
                           {json.at("width").get<int>(), json.at("height").get<int>()},
                           json.at("lost").get<std::string>()};
  for (const auto& phase : json.at("phases")) {
    recording.phases.push_back(
        {phase.at("name").get<std::string>(),
         {phase.at("begin_us").get<std::int64_t>(), phase.at("end_us").get<std::int64_t>()}});
  }
  return recording;
}

std::string truth_crc32(const InputRun& run) {
  std::string content = read_text_file(run.input.truth);
  if (!run.truth.truth.corners.empty()) content += read_text_file(run.truth.truth.corners);
  return crc32_of(content);
}

/// What the options of all cells name that is a file.
std::map<std::string, std::string> files_of(const SweepConfig& config) {
  ReconConfig base;
  base.set_json(config.base.json(), "config");
  std::vector<std::string> texts{base.frames.times, base.steps.undistort};
  for (const Option& option : base.method_options().options()) texts.push_back(option.text());
  const SweepGrid grid = config.grid();
  for (const SweepAxis& axis : grid.axes()) texts.insert(texts.end(), axis.values.begin(), axis.values.end());
  std::map<std::string, std::string> files;
  for (const std::string& text : texts) {
    std::error_code error;
    if (std::filesystem::is_regular_file(text, error))
      files[text] = crc32_of(read_text_file(text, kMostFileBytes));
  }
  return files;
}

void refuse_twice(const SweptRecording& recording, const std::vector<SweptRecording>& others) {
  for (const SweptRecording& other : others) {
    if (other.crc32 != recording.crc32 || other.truth_crc32 != recording.truth_crc32) continue;
    throw usage_error(
        fmt::format("{} and {}: hold the same recording; give it once", other.path, recording.path));
  }
}

void refuse_total(const SweptRecording& recording) {
  for (const Phase& phase : recording.phases) {
    if (phase.name != "total") continue;
    throw usage_error(recording.truth_path + ": a phase called total can't be told from all phases together");
  }
}

nlohmann::json without_paths(nlohmann::json header) {
  for (auto& recording : header["recordings"]) {
    recording.erase("path");
    recording.erase("ground_truth");
  }
  header.erase("shard");
  return header;
}

}  // namespace

nlohmann::json to_json(const SweepHeader& header) {
  nlohmann::json json = {{"store", kStoreForm},
                         {"version", header.version},
                         {"config", header.config.json()},
                         {"files", header.files},
                         {"recordings", nlohmann::json::array()}};
  for (const SweptRecording& recording : header.recordings) json["recordings"].push_back(to_json(recording));
  return json;
}

SweepHeader header_from(const nlohmann::json& json) {
  try {
    if (json.at("store").get<std::string>() != kStoreForm) throw Error("is no store of this form");
    SweepHeader header;
    header.version = json.at("version").get<std::string>();
    header.config.set_json(json.at("config"), "config", {});
    header.files = json.at("files").get<std::map<std::string, std::string>>();
    for (const auto& entry : json.at("recordings")) header.recordings.push_back(recording_from(entry));
    return header;
  } catch (const nlohmann::json::exception& error) {
    throw Error(error.what());
  }
}

std::string losses_of(const SweepHeader& header) {
  std::string losses;
  for (const SweptRecording& recording : header.recordings) {
    if (recording.lost.empty()) continue;
    losses += fmt::format("{}{}: {}", losses.empty() ? "" : "; ", recording.path, recording.lost);
  }
  return losses;
}

std::string difference(const nlohmann::json& a, const nlohmann::json& b) {
  const nlohmann::json one = without_paths(a).flatten(), other = without_paths(b).flatten();
  for (const auto& [key, value] : one.items()) {
    const auto found = other.find(key);
    if (found == other.end()) return fmt::format("{} was {} and is not there now", key, value.dump());
    if (*found != value) return fmt::format("{} was {} and is {}", key, value.dump(), found->dump());
  }
  for (const auto& [key, value] : other.items()) {
    if (!one.contains(key)) return fmt::format("{} was not there and is {}", key, value.dump());
  }
  return "";
}

SweepHeader survey(const SweepConfig& config, std::vector<InputRun>& runs, const Observer& observer) {
  const EvalConfig nothing = config.eval_config(config.grid(), {});
  Evaluation read = evaluate(nothing, load_inputs(nothing, config.inputs), 1, observer);
  runs = std::move(read.inputs);
  SweepHeader header{std::string(version()), {}, {}, {}};
  header.config.set_json(config.json(), "config", {});
  if (read.stopped) return header;
  header.files = files_of(config);
  for (const InputRun& run : runs) {
    SweptRecording recording{
        run.input.path.string(), run.input.truth.string(), run.digest->events(),   run.digest->crc32(),
        truth_crc32(run),        run.duration_s,           run.truth.truth.phases, run.size,
        run.losses.text()};
    refuse_total(recording);
    refuse_twice(recording, header.recordings);
    header.recordings.push_back(std::move(recording));
  }
  return header;
}

}  // namespace esi

#include "recon_inquiries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/check/recording_check.hpp"
#include "esi/io/recording_info.hpp"

namespace esi::cli {
namespace {

/// What is said of one recording.
struct Answer {
  nlohmann::json json;
  std::string text;
  bool has_losses = false;
};

Answer inquire(const std::filesystem::path& path, const ReconArguments& arguments) {
  const auto source = open_recording(path, arguments.config.read);
  RecordingInfo info;
  std::optional<CheckReport> check;
  if (arguments.check) {
    check = check_recording(*source, info);
  } else {
    info = inspect(*source);
  }
  Answer answer{to_json(info), path.string() + "\n" + to_text(info), info.losses.any()};
  answer.json["path"] = path.string();
  if (check) answer.json["check"] = to_json(*check, info);
  if (check) answer.text += to_text(*check);
  return answer;
}

}  // namespace

std::string methods_text() {
  std::string text;
  for (const Method& method : methods()) {
    text += fmt::format("{:<15} {}\n{:<15} {}\n", method.name, method.summary, "", method.source);
    const auto config = method.configure();
    for (const Option& option : config->options().options()) {
      const std::string value = fmt::format("{}={}", option.name(), option.text());
      text += fmt::format("{:<17}{:<26} {} [{}]\n", "", value, option.help(), option.domain());
    }
  }
  return text;
}

std::string formats_text() {
  std::string text;
  for (const Format& format : formats()) {
    text += fmt::format("{:<10} {:<14} {}\n", format.name, format.extensions, format.summary);
  }
  return text;
}

std::string config_text(const ReconConfig& config) { return json_text(config.json()); }

int print_info(const ReconArguments& arguments) {
  int worst = kDone;
  nlohmann::json all = nlohmann::json::array();
  for (const auto& path : arguments.recordings) {
    try {
      Answer answer = inquire(path, arguments);
      if (answer.has_losses) worst = std::max<int>(worst, kDoneWithLosses);
      if (arguments.json) {
        all.push_back(std::move(answer.json));
      } else {
        fmt::print("{}{}", &path == &arguments.recordings.front() ? "" : "\n", answer.text);
      }
    } catch (const std::exception& error) {
      worst = worst_of(worst, report("esi-recon", error));
    }
  }
  if (arguments.json) fmt::print("{}", json_text(all.size() == 1 ? all.front() : all));
  return worst;
}

}  // namespace esi::cli

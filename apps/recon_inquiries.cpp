#include "recon_inquiries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli.hpp"
#include "esi/io/recording_info.hpp"

namespace esi::cli {
namespace {

nlohmann::json info_json(const RecordingInfo& info, const std::string& path) {
  nlohmann::json json = to_json(info);
  json["path"] = path;
  return json;
}

std::string dump(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string methods_text() {
  std::string text;
  for (const Method& method : methods()) {
    text += fmt::format("{:<10} {}\n{:<10} {}\n", method.name, method.summary, "", method.source);
    const auto config = method.configure();
    for (const Option& option : config->options().options()) {
      const std::string value = fmt::format("{}={}", option.name(), option.text());
      text += fmt::format("{:<12}{:<26} {} [{}]\n", "", value, option.help(), option.domain());
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

std::string config_text(const ReconConfig& config) { return dump(config.json()); }

int print_info(const ReconArguments& arguments) {
  int worst = kDone;
  nlohmann::json all = nlohmann::json::array();
  for (const auto& path : arguments.recordings) {
    try {
      const auto source = open_recording(path, arguments.config.read);
      const RecordingInfo info = inspect(*source);
      if (info.losses.any()) worst = std::max<int>(worst, kDoneWithLosses);
      if (arguments.json) {
        all.push_back(info_json(info, path.string()));
      } else {
        fmt::print("{}{}\n{}", &path == &arguments.recordings.front() ? "" : "\n", path.string(),
                   to_text(info));
      }
    } catch (const std::exception& error) {
      worst = worst_of(worst, report("esi-recon", error));
    }
  }
  if (arguments.json) fmt::print("{}", dump(all.size() == 1 ? all.front() : all));
  return worst;
}

}  // namespace esi::cli

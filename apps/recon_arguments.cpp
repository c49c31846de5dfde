#include "recon_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "cli.hpp"
#include "esi/core/error.hpp"
#include "esi/core/version.hpp"
#include "esi/io/format_reader.hpp"

namespace esi::cli {
namespace {

namespace fs = std::filesystem;

bool has_known_extension(const fs::path& path) {
  const std::string extension = path.extension().string();
  return !extension.empty() && std::any_of(formats().begin(), formats().end(), [&](const Format& format) {
    return fmt::format(" {} ", format.extensions).find(" " + extension + " ") != std::string::npos;
  });
}

// A folder stands for the recordings in it (not below it), by name.
void add_recordings(const std::string& given, std::vector<fs::path>& recordings) {
  if (given.empty()) throw usage_error("a recording's path is empty");
  std::error_code none;
  if (!fs::is_directory(given, none)) return recordings.emplace_back(given), void();
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(given)) {
    if (entry.is_regular_file() && has_known_extension(entry.path())) found.push_back(entry.path());
  }
  if (found.empty()) throw Error(given + ": there are no recordings in this folder (see --list-formats)");
  std::sort(found.begin(), found.end());
  recordings.insert(recordings.end(), found.begin(), found.end());
}

}  // namespace

bool parse_recon_arguments(int argc, const char* const* argv, ReconArguments& arguments, int& exit_code) {
  std::vector<std::string> given, settings;
  std::string config_file, method;
  std::int64_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::int64_t jobs = 1;

  CLI::App app("event recordings to grey images", "esi-recon");
  app.set_version_flag("--version", fmt::format("esi-recon {}", version()));
  app.add_option("RECORDING", given, "recordings, or folders of them; - is standard input")->type_name("");
  app.add_option("-o,--output", arguments.output,
                 "a folder for PNG files, a video (.mp4, .mkv, .avi), or - for YUV4MPEG2 on standard output")
      ->type_name("OUT");
  app.add_option(
         "--flow-out", arguments.flow_output,
         "a folder for the image's motion in px/s, where the method estimates it: Middlebury .flo files, "
         "and pictures in which the hue is the direction")
      ->type_name("DIR");
  app.add_option("--method", method, "method, or a config file with one (see --list-methods)")
      ->type_name("NAME");
  app.add_option("--config", config_file, "options from a JSON file")->type_name("FILE");
  app.add_option("--set", settings, "an option of the method, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  TableFlags flags;
  for (auto& group : arguments.config.groups()) flags.add(app, std::move(group.table), group.title);
  const std::string running = "Running";
  app.add_option("--threads", threads, "threads for each recording")->type_name("N")->group(running);
  app.add_option("--jobs", jobs, "recordings at the same time")->type_name("N")->group(running);
  app.add_flag("--quiet", arguments.quiet, "no progress and no summary")->group(running);
  const std::string asking = "Asking";
  app.add_flag("--info", arguments.info, "say what the recordings hold")->group(asking);
  app.add_flag("--check", arguments.check,
               "--info, and whether the recordings are good: rate, pauses, hot pixels")
      ->group(asking);
  app.add_flag("--json", arguments.json, "--info as JSON")->group(asking);
  app.add_flag("--list-methods", arguments.list_methods, "methods, sources and defaults")->group(asking);
  app.add_flag("--list-formats", arguments.list_formats, "formats that can be read")->group(asking);
  app.add_flag("--print-config", arguments.print_config, "the merged options as a config")->group(asking);
  if (!parse(app, argc, argv, exit_code)) return false;

  arguments.info = arguments.info || arguments.check;
  if (!config_file.empty()) arguments.config.load(config_file);
  if (!method.empty()) arguments.config.choose_method(method);
  for (const std::string& setting : settings) arguments.config.set(setting);
  flags.apply();
  arguments.config.frames.check();
  arguments.config.steps.check();
  arguments.threads = checked_threads("--threads", threads);
  arguments.jobs = checked_threads("--jobs", jobs);
  for (const std::string& path : given) add_recordings(path, arguments.recordings);
  return true;
}

}  // namespace esi::cli

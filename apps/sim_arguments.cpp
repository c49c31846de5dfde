#include "sim_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/core/version.hpp"
#include "esi/io/output/frame_sink.hpp"

namespace esi::cli {
namespace {

void require_folder(const std::string& output) {
  if (output.empty()) throw usage_error("say with -o into which folder the simulation shall go");
  if (output != "-" && means_folder(output)) return;
  throw usage_error(fmt::format("-o {}: give a folder; --preview makes a video in it", output));
}

}  // namespace

bool parse_sim_arguments(int argc, const char* const* argv, SimArguments& arguments, int& exit_code) {
  std::vector<std::string> config_files, settings;

  CLI::App app("simulated event recordings, with all that is true of them", "esi-sim");
  app.set_version_flag("--version", fmt::format("esi-sim {}", version()));
  app.add_option("-o,--output", arguments.output, "folder for the recording and its truth")->type_name("DIR");
  app.add_option("--config", config_files, "options from a JSON file, such as configs/sim/flight-dim.json")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--set", settings, "an option by its name in configs, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  TableFlags flags;
  for (auto& group : arguments.config.groups()) flags.add(app, std::move(group.table), group.title);
  arguments.running.add(app);
  if (!parse(app, argc, argv, exit_code)) return false;

  for (const std::string& file : config_files) arguments.config.load(file);
  for (const std::string& setting : settings) arguments.config.set(setting);
  flags.apply();
  arguments.threads = checked_threads("--threads", arguments.running.threads);
  if (!arguments.running.print_config) require_folder(arguments.output);
  return true;
}

}  // namespace esi::cli

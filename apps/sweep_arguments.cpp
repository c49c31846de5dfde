#include "sweep_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "esi/core/error.hpp"
#include "esi/core/version.hpp"
#include "eval_inputs.hpp"

namespace esi::cli {
namespace {

struct Given {
  std::vector<std::string> recordings, truths, config_files, sets, grid, shards;
  std::string method, output, shard;
};

std::filesystem::path output_folder(const std::string& output) {
  if (output.empty()) throw usage_error("say with -o into which folder the results shall go");
  if (output == "-" || !means_folder(output)) throw usage_error(fmt::format("-o {}: give a folder", output));
  return output;
}

void add_flags(CLI::App& app, Given& given, SweepArguments& arguments) {
  app.add_option("RECORDING", given.recordings, "recordings; each cell is judged on all of them");
  app.add_option("-g,--ground-truth", given.truths,
                 "ground truth of each recording, in their order, or one for all; default: ground_truth.json "
                 "beside it")
      ->type_name("FILE");
  app.add_option("-o,--output", given.output,
                 "folder for the results; a sweep that was stopped goes on there")
      ->type_name("DIR");
  app.add_option("--method", given.method, "a method, or a config file of esi-recon")->type_name("NAME");
  app.add_option("--set", given.sets, "KEY=VALUE for an option of the method that isn't swept, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--grid", given.grid,
                 "OPTION=1,2,5 or OPTION=FIRST:LAST:STEP or OPTION=log:FIRST:LAST:COUNT, repeatable: every "
                 "combination is a cell")
      ->type_name("OPTION=VALUES")
      ->allow_extra_args(false);
  app.add_option("--config", given.config_files, "sweep from a JSON file")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--shard", given.shard, "only part I of N of the cells; esi-sweep merge puts them together")
      ->type_name("I/N");
  app.add_flag("--plan", arguments.plan, "print how many cells there are and how long they take, and end");
}

void refuse_set_of_swept(const std::vector<std::string>& sets, const SweepGrid& grid) {
  for (const std::string& assignment : sets) {
    for (const SweepAxis& axis : grid.axes()) {
      if (assignment.substr(0, assignment.find('=')) != axis.option) continue;
      throw usage_error(fmt::format("--set {}: the grid varies {}", assignment, axis.option));
    }
  }
}

void take_config(const Given& given, TableFlags& flags, SweepConfig& config) {
  for (const std::string& file : given.config_files) config.load(file);
  if (!given.method.empty()) config.choose_method(given.method);
  for (const std::string& assignment : given.sets) config.base.set(assignment);
  for (const std::string& axis : given.grid) config.add_axis(parse_axis(axis));
  flags.apply();
  refuse_set_of_swept(given.sets, config.grid());
  if (given.recordings.empty() && !given.truths.empty()) {
    throw usage_error(
        "-g goes with recordings on the command line; those of a config have their truths there");
  }
  if (!given.recordings.empty()) config.inputs = recordings_with_truths(given.recordings, given.truths);
}

bool parse_sweep(int argc, const char* const* argv, SweepArguments& arguments, int& exit_code) {
  Given given;
  CLI::App app("what each parameter of a method does: tags found for every combination of values",
               "esi-sweep");
  app.set_version_flag("--version", fmt::format("esi-sweep {}", version()));
  app.footer("esi-sweep merge DIR... -o DIR puts the shards of a sweep together.");
  add_flags(app, given, arguments);
  TableFlags flags;
  for (auto& group : arguments.config.groups()) flags.add(app, std::move(group.table), group.title);
  arguments.running.add(app);
  if (!parse(app, argc, argv, exit_code)) return false;
  take_config(given, flags, arguments.config);
  arguments.job.threads = checked_threads("--threads", arguments.running.threads);
  if (!given.shard.empty()) arguments.job.shard = parse_shard(given.shard);
  if (!arguments.running.print_config && !arguments.plan) arguments.job.output = output_folder(given.output);
  return true;
}

bool parse_merge(int argc, const char* const* argv, SweepArguments& arguments, int& exit_code) {
  Given given;
  CLI::App app("puts the shards of a sweep together", "esi-sweep merge");
  app.add_option("DIR", given.shards, "folders of all shards")->required();
  app.add_option("-o,--output", given.output, "folder for the results")->type_name("DIR");
  app.add_flag("--quiet", arguments.running.quiet, "no summary");
  if (!parse(app, argc, argv, exit_code)) return false;
  arguments.shards.assign(given.shards.begin(), given.shards.end());
  arguments.job.output = output_folder(given.output);
  return true;
}

}  // namespace

bool parse_sweep_arguments(int argc, const char* const* argv, SweepArguments& arguments, int& exit_code) {
  const bool is_merge = argc > 1 && std::string_view(argv[1]) == "merge";
  return is_merge ? parse_merge(argc - 1, argv + 1, arguments, exit_code)
                  : parse_sweep(argc, argv, arguments, exit_code);
}

}  // namespace esi::cli

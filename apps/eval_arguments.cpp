#include "eval_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/core/version.hpp"
#include "esi/io/output/frame_sink.hpp"
#include "eval_inputs.hpp"

namespace esi::cli {
namespace {

struct Given {
  std::vector<std::string> recordings, frames, truths, methods, config_files, requirements;
  std::string output;
};

std::vector<EvalInput> inputs_of(const Given& given) {
  std::vector<EvalInput> inputs;
  for (const std::string& path : given.recordings) inputs.push_back({path, {}, false});
  for (const std::string& path : given.frames) inputs.push_back({path, {}, true});
  if (inputs.empty()) throw usage_error("give a recording, or with --frames a folder of frames");
  give_truths(inputs, given.truths);
  return inputs;
}

}  // namespace

bool parse_eval_arguments(int argc, const char* const* argv, EvalArguments& arguments, int& exit_code) {
  Given given;

  CLI::App app("what reconstructed images are worth, by the AprilTags found in them", "esi-eval");
  app.set_version_flag("--version", fmt::format("esi-eval {}", version()));
  app.add_option("RECORDING", given.recordings, "recordings, each read once for all methods")->type_name("");
  app.add_option("--frames", given.frames,
                 "folders of frames that any tool made, with images.txt or timestamps.txt")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_option(
         "-g,--ground-truth", given.truths,
         "ground truth of each input, in their order, or one for all; default: ground_truth.json beside it")
      ->type_name("FILE");
  app.add_option("-o,--output", given.output, "folder for the report")->type_name("DIR");
  app.add_option("--method", given.methods, "a method or a config file of esi-recon, repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false);
  app.add_option("--config", given.config_files, "options from a JSON file")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--require", given.requirements,
                 "PHASE>=RATE or METHOD:PHASE>=RATE, else exit with 4; repeatable")
      ->type_name("RATE")
      ->allow_extra_args(false);
  TableFlags flags;
  for (auto& group : arguments.config.groups()) flags.add(app, std::move(group.table), group.title);
  arguments.running.add(app);
  app.add_flag("--force", arguments.job.force, "replace an older report in the output folder")
      ->group(RunningFlags::kGroup);
  if (!parse(app, argc, argv, exit_code)) return false;

  for (const std::string& file : given.config_files) arguments.config.load(file);
  for (const std::string& method : given.methods) arguments.config.add_method(method);
  flags.apply();
  arguments.config.check();
  arguments.job.threads = checked_threads("--threads", arguments.running.threads);
  for (const std::string& text : given.requirements) {
    arguments.job.requirements.push_back(parse_requirement(text));
  }
  if (arguments.running.print_config) return true;
  arguments.job.inputs = inputs_of(given);
  if (given.output.empty()) throw usage_error("say with -o into which folder the report shall go");
  if (given.output == "-" || !means_folder(given.output)) {
    throw usage_error(fmt::format("-o {}: give a folder", given.output));
  }
  arguments.job.output = given.output;
  return true;
}

}  // namespace esi::cli

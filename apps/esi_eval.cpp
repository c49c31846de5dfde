#include <fmt/format.h>

#include <utility>

#include "cli.hpp"
#include "esi/core/json_text.hpp"
#include "eval_arguments.hpp"
#include "progress_bar.hpp"
#include "signals.hpp"

namespace {

using namespace esi;

const char* const kTool = "esi-eval";

int run(int argc, char** argv) {
  cli::EvalArguments arguments;
  int exit_code = cli::kDone;
  if (!cli::parse_eval_arguments(argc, argv, arguments, exit_code)) return exit_code;
  if (arguments.running.print_config) return fmt::print("{}", json_text(arguments.config.json())), cli::kDone;

  arguments.job.tool = kTool;
  EvalReport report;
  {
    cli::ProgressBar bar(!arguments.running.quiet);
    std::size_t input = 0;
    report = run_job(arguments.job, arguments.config, [&](const Progress& p) {
      if (p.input != std::exchange(input, p.input)) bar.restart();
      bar.show(p.events, p.frames, p.t_us, p.fraction);
      return cli::stop_signal() == 0;
    });
  }
  if (report.stopped) return cli::stop_exit_code();
  if (!arguments.running.quiet) fmt::print("{}", report.summary);
  for (const std::string& sentence : report.missed) cli::say(kTool, sentence);
  if (report.has_losses) cli::say(kTool, "part of the input was left out: " + report.losses);
  if (!report.missed.empty()) return cli::kRequirementMissed;
  return report.has_losses ? cli::kDoneWithLosses : cli::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  esi::cli::install_signal_handlers();
  return esi::cli::guarded(kTool, [&] { return run(argc, argv); });
}

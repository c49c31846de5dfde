#include <fmt/format.h>

#include "cli.hpp"
#include "esi/core/json_text.hpp"
#include "progress_bar.hpp"
#include "signals.hpp"
#include "sweep_arguments.hpp"

#ifdef ESI_WITH_MPI
#include "mpi_team.hpp"
#endif

namespace {

using namespace esi;

const char* const kTool = "esi-sweep";

SweepReport sweep(const cli::SweepArguments& arguments) {
  if (!arguments.shards.empty()) return merge_sweeps(arguments.shards, arguments.job);
  cli::ProgressBar bar(!arguments.running.quiet);
  return run_sweep(arguments.job, arguments.config, [&bar](const SweepProgress& progress) {
    bar.show_share("cells", progress.done, progress.known);
    return cli::stop_signal() == 0;
  });
}

int run(int argc, char** argv, SweepTeam* team) {
  cli::SweepArguments arguments;
  int exit_code = cli::kDone;
  if (!cli::parse_sweep_arguments(argc, argv, arguments, exit_code)) return exit_code;
  if (arguments.running.print_config) return fmt::print("{}", json_text(arguments.config.json())), cli::kDone;
  if (arguments.plan) return fmt::print("{}", plan_text(arguments.config, arguments.job.threads)), cli::kDone;

  arguments.job.tool = kTool;
  arguments.job.team = team;
  const SweepReport report = sweep(arguments);
  if (report.stopped) return cli::stop_exit_code();
  if (!arguments.running.quiet) fmt::print("{}", report.summary);
  if (!report.losses.empty()) cli::say(kTool, "part of the input was left out: " + report.losses);
  return report.losses.empty() ? cli::kDone : cli::kDoneWithLosses;
}

}  // namespace

int main(int argc, char** argv) {
  esi::cli::install_signal_handlers();
#ifdef ESI_WITH_MPI
  esi::cli::MpiTeam team(argc, argv);
  return team.end(
      esi::cli::guarded(kTool, [&] { return run(argc, argv, team.processes() > 1 ? &team : nullptr); }));
#else
  return esi::cli::guarded(kTool, [&] { return run(argc, argv, nullptr); });
#endif
}

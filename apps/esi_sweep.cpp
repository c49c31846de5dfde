#include <fmt/format.h>

#include <optional>

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

/// What this process is to a team of them; without MPI there is none.
struct Part {
  SweepTeam* team = nullptr;
  std::optional<int> threads;  ///< unless --threads says otherwise

  bool is_leader() const { return team == nullptr || team->is_leader(); }
};

SweepReport sweep(const cli::SweepArguments& arguments, const Part& part) {
  if (!arguments.shards.empty()) return merge_sweeps(arguments.shards, arguments.job);
  cli::ProgressBar bar(!arguments.running.quiet && part.is_leader());
  return run_sweep(arguments.job, arguments.config, [&bar](const SweepProgress& progress) {
    bar.show_share("cells", progress.done, progress.known);
    return cli::stop_signal() == 0;
  });
}

int run(int argc, char** argv, const Part& part) {
  cli::SweepArguments arguments;
  if (part.threads) arguments.running.threads = *part.threads;
  int exit_code = cli::kDone;
  if (!cli::parse_sweep_arguments(argc, argv, arguments, exit_code)) return exit_code;
  const bool is_for_one = arguments.running.print_config || arguments.plan || !arguments.shards.empty();
  if (is_for_one && !part.is_leader()) return cli::kDone;
  if (arguments.running.print_config) return fmt::print("{}", json_text(arguments.config.json())), cli::kDone;
  if (arguments.plan) return fmt::print("{}", plan_text(arguments.config, arguments.job.threads)), cli::kDone;

  arguments.job.tool = kTool;
  arguments.job.team = part.team;
  const SweepReport report = sweep(arguments, part);
  // Without a signal it was another process of the team that failed or was stopped; that one says why.
  if (report.stopped) return cli::stop_signal() == 0 ? cli::kFailed : cli::stop_exit_code();
  if (!arguments.running.quiet) fmt::print("{}", report.summary);
  if (!report.losses.empty()) cli::say(kTool, "part of the input was left out: " + report.losses);
  return report.losses.empty() ? cli::kDone : cli::kDoneWithLosses;
}

}  // namespace

int main(int argc, char** argv) {
  esi::cli::install_signal_handlers();
#ifdef ESI_WITH_MPI
  esi::cli::MpiTeam team(argc, argv);
  if (team.processes() > 1) {
    return team.end(esi::cli::guarded(kTool, [&] { return run(argc, argv, {&team, team.threads()}); }));
  }
#endif
  return esi::cli::guarded(kTool, [&] { return run(argc, argv, {}); });
}

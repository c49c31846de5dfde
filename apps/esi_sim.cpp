#include <fmt/format.h>

#include "cli.hpp"
#include "esi/core/json_text.hpp"
#include "esi/pipeline/sim_job.hpp"
#include "progress_bar.hpp"
#include "signals.hpp"
#include "sim_arguments.hpp"

namespace {

using namespace esi;
constexpr auto kTool = "esi-sim";

std::string summary_line(const SimReport& report, const std::string& output) {
  const double lasts_s = static_cast<double>(report.t_us) * 1e-6;
  const double million_events = static_cast<double>(report.events) * 1e-6;
  return fmt::format("{} events ({:.2f} Mev/s), {} intensity frames, {:g} s in {:.1f} s -> {}", report.events,
                     million_events / lasts_s, report.intensity_frames, lasts_s, report.wall_s, output);
}

SimReport simulate(const cli::SimArguments& arguments) {
  cli::ProgressBar bar(!arguments.running.quiet);
  return run_job({arguments.output, arguments.threads, kTool}, arguments.config, [&bar](const Progress& p) {
    bar.show(p.events, p.frames, p.t_us, p.fraction);
    return cli::stop_signal() == 0;
  });
}

int run(int argc, char** argv) {
  cli::SimArguments arguments;
  int exit_code = cli::kDone;
  if (!cli::parse_sim_arguments(argc, argv, arguments, exit_code)) return exit_code;
  if (arguments.running.print_config) return fmt::print("{}", json_text(arguments.config.json())), cli::kDone;

  const SimReport report = simulate(arguments);
  if (report.stopped) return cli::stop_exit_code();
  if (!arguments.running.quiet) cli::say(kTool, summary_line(report, arguments.output));
  return cli::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  esi::cli::install_signal_handlers();
  return esi::cli::guarded(kTool, [&] { return run(argc, argv); });
}

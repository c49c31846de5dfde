#include "recon_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "cli.hpp"
#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/recon_job.hpp"
#include "progress_bar.hpp"
#include "signals.hpp"

namespace esi::cli {
namespace {

namespace fs = std::filesystem;
constexpr auto kTool = "esi-recon";

struct Outcome {
  int exit_code = kInterrupted;
  std::optional<ReconReport> report;
};

std::string summary_line(const ReconReport& report, const fs::path& output) {
  const double million_events = static_cast<double>(report.result.digest.events()) * 1e-6;
  const double lasts_s = static_cast<double>(report.result.digest.duration_us()) * 1e-6;
  return fmt::format("{} events, {} frames in {:.2f} s ({:.1f} Mev/s, {:.1f} x real time) -> {}",
                     report.result.digest.events(), report.result.frames, report.wall_s,
                     million_events / report.wall_s, lasts_s / report.wall_s,
                     output == "-" ? "standard output" : output.string());
}

int exit_code_of(const ReconReport& report) {
  if (report.result.stopped) return stop_exit_code();
  return report.losses.any() ? kDoneWithLosses : kDone;
}

Outcome run_one(const ReconJob& job, const ReconArguments& arguments, bool with_bar) {
  Outcome outcome;
  try {
    ProgressBar bar(with_bar && !arguments.quiet);
    outcome.report = run_job(job, arguments.config, [&bar](const Progress& p) {
      bar.show(p.events, p.frames, p.t_us, p.fraction);
      return stop_signal() == 0;
    });
    outcome.exit_code = exit_code_of(*outcome.report);
  } catch (const ClosedPipe&) {
    outcome.exit_code = kPipeClosed;
  } catch (const std::exception& error) {
    outcome.exit_code = report(kTool, error);
  }
  if (!outcome.report) return outcome;
  if (outcome.report->losses.any()) {
    say(kTool, fmt::format("{}: lost: {}", job.recording.string(), outcome.report->losses.text()));
  }
  if (!arguments.quiet) say(kTool, summary_line(*outcome.report, job.output));
  return outcome;
}

// What tells a recording from the others: its name without extension, else with it, else with its folder's
// name.
std::string name_among(const fs::path& path, const std::vector<fs::path>& all) {
  static constexpr std::string (*kNames[])(const fs::path&) = {
      [](const fs::path& p) { return p.stem().string(); },
      [](const fs::path& p) { return p.filename().string(); },
      [](const fs::path& p) {
        return fs::absolute(p).parent_path().filename().string() + "-" + p.filename().string();
      },
  };
  for (const auto name_of : kNames) {
    std::string name = name_of(path);
    const auto has_same = [&](const fs::path& other) { return name_of(other) == name; };
    if (std::count_if(all.begin(), all.end(), has_same) == 1) return name;
  }
  throw usage_error(fmt::format("{}: two recordings would get the same output folder; give each its own -o",
                                path.string()));
}

std::vector<ReconJob> make_jobs(const ReconArguments& arguments) {
  std::vector<ReconJob> jobs;
  for (const fs::path& path : arguments.recordings) {
    fs::path output = arguments.output;
    fs::path flow_output = arguments.flow_output;
    if (arguments.recordings.size() > 1) {
      const std::string name = name_among(path, arguments.recordings);
      output /= name;
      if (!flow_output.empty()) flow_output /= name;
    }
    jobs.push_back({path, output, arguments.threads, kTool, flow_output});
  }
  return jobs;
}

void write_summary(const fs::path& path, const std::vector<ReconJob>& jobs,
                   const std::vector<Outcome>& outcomes) {
  std::string text = "recording,output,exit_code,events,frames,dropped\n";
  const auto quoted = [](std::string field) {
    if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
    for (std::size_t i = 0; (i = field.find('"', i)) != std::string::npos; i += 2) field.insert(i, 1, '"');
    return "\"" + field + "\"";
  };
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& report = outcomes[i].report;
    text += fmt::format("{},{},{},{},{},{}\n", quoted(jobs[i].recording.string()),
                        quoted(jobs[i].output.string()), outcomes[i].exit_code,
                        report ? report->result.digest.events() : 0, report ? report->result.frames : 0,
                        report ? report->losses.dropped() : 0);
  }
  write_file(path, text);
}

void check_batch(const ReconArguments& arguments) {
  if (arguments.recordings.empty()) throw usage_error("give a recording (see esi-recon --help)");
  if (arguments.output.empty())
    throw usage_error("say with -o where the frames shall go: a folder, a video or -");
  const fs::path output = arguments.output;
  if (arguments.recordings.size() > 1 && (output == "-" || !means_folder(output))) {
    throw usage_error(fmt::format("-o {}: several recordings need a folder", arguments.output));
  }
}

}  // namespace

int run_batch(const ReconArguments& arguments) {
  check_batch(arguments);
  const std::vector<ReconJob> jobs = make_jobs(arguments);
  std::vector<Outcome> outcomes(jobs.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i; stop_signal() == 0 && (i = next++) < jobs.size();) {
      outcomes[i] = run_one(jobs[i], arguments, arguments.jobs == 1);
    }
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < arguments.jobs; ++i) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();

  if (jobs.size() > 1) write_summary(fs::path(arguments.output) / "summary.csv", jobs, outcomes);
  int worst = kDone;
  for (const Outcome& outcome : outcomes) worst = worst_of(worst, outcome.exit_code);
  return worst;
}

}  // namespace esi::cli

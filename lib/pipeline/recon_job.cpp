#include "esi/pipeline/recon_job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/io/output/run_manifest.hpp"
#include "esi/pipeline/ready_method.hpp"
#include "esi/pipeline/reconstruction/motion_sink.hpp"
#include "esi/pipeline/stopwatch.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

std::string name_of(const ReconJob& job) {
  return job.recording == "-" ? "standard input" : job.recording.string();
}

void refuse_same_file(const ReconJob& job) {
  std::error_code absent;
  if (fs::equivalent(job.recording, job.output, absent)) {
    throw usage_error(
        fmt::format("{}: the output would overwrite the recording; give another -o", job.output.string()));
  }
}

// FNV-1a, 64 bits: equal for the same recording (path and size) and options, else almost surely different.
// What is to happen to an older run's output makes no difference to this run's.
std::string fingerprint_of(const ReconJob& job, nlohmann::json config, const nlohmann::json& files) {
  if (!files.empty()) config["files"] = files;
  config.erase("force");
  config.erase("resume");
  std::error_code no_file;
  const auto bytes = fs::file_size(job.recording, no_file);
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : fmt::format("{}\n{}\n{}", job.recording.string(), no_file ? 0 : bytes, config.dump())) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return fmt::format("{:016x}", hash);
}

// The file declares intensity frames, but that doesn't mean that there are any.
void refuse_frameless(const Reconstruction& result, const ReconConfig& config, const std::string& name) {
  const bool needs_them = config.method().frames == FrameUse::required || config.frames.at_frames;
  if (result.intensity_frames > 0 || !needs_them) return;
  throw Error(fmt::format(
      "{}: there are no intensity frames in the part that was asked for, and {} needs them", name,
      config.frames.at_frames ? "--at-frames" : fmt::format("method '{}'", config.method().name)));
}

void refuse_nothing(const Reconstruction& result, const EventSource& source, const std::string& name) {
  if (result.digest.events() > 0 || result.stopped) return;
  const std::string lost = source.losses().any() ? " (lost: " + source.losses().text() + ")" : "";
  throw Error(fmt::format("{}: there are no events{} in the part that was asked for", name, lost));
}

std::unique_ptr<FrameSink> open_sink(const ReconJob& job, const ReconConfig& config, Reconstructor& method,
                                     const SinkContext& context) {
  if (job.motion_output.empty()) return open_frame_sink(job.output, config.sink, context);
  if (method.motion() == nullptr) {
    throw usage_error(
        fmt::format("--flow-out: method '{}' doesn't estimate motion; esi-flow does", config.method().name));
  }
  const std::string frames_folder = (fs::absolute(job.output) / "").lexically_normal().string();
  if ((fs::absolute(job.motion_output) / "").lexically_normal().string().starts_with(frames_folder)) {
    throw usage_error("--flow-out needs a folder of its own, neither that of the frames nor one within it");
  }
  if (config.sink.resume) throw usage_error("--flow-out can't be resumed; leave --resume or --flow-out away");
  require_usable_folder(job.motion_output, config.sink, kMotionContent);
  auto frames = open_frame_sink(job.output, config.sink, context);
  return std::make_unique<MotionSink>(std::move(frames), method, job.motion_output, config.sink,
                                      context.fingerprint);
}

}  // namespace

ReconReport run_job(const ReconJob& job, const ReconConfig& config, const Observer& observer) {
  const Stopwatch watch;
  const std::string name = name_of(job);
  config.frames.check();
  refuse_same_file(job);
  const auto schedule = config.frames.make_schedule();
  auto recording = open_recording(job.recording, config.read);
  const auto sensor = recording->sensor_size();
  CropSource source(std::move(recording), config.frames.interval(), config.frames.region());

  ReconReport report;
  report.size = require_sensor_size(source, name);
  ReadyMethod method(config, {job.recording, name, config.read, &source.header(),
                              sensor.value_or(report.size), config.frames.region()});
  const nlohmann::json effective = config.json();
  const std::string fingerprint = fingerprint_of(job, effective, method.files_json());
  const auto workers = std::make_shared<WorkerPool>(job.threads - 1);
  method.reconstructor().use_workers(workers);
  const auto sink = open_sink(job, config, method.reconstructor(),
                              {report.size, config.frames.video_fps(), fingerprint, workers});

  report.result =
      reconstruct(source, *schedule, method.reconstructor(), *sink, config.frames.max_frames, name, observer);
  report.losses = source.losses();
  report.wall_s = watch.seconds();
  if (report.result.stopped) {
    sink->stop();
    return report;
  }
  refuse_nothing(report.result, source, name);
  refuse_frameless(report.result, config, name);
  sink->finish(to_text(RunManifest{job.tool,
                                   job.recording.string(),
                                   source.header(),
                                   report.size,
                                   report.result.digest,
                                   source.time_zero_us(),
                                   report.losses,
                                   report.result.frames,
                                   report.result.intensity_frames,
                                   method.steps_json(),
                                   method.files_json(),
                                   effective,
                                   fingerprint,
                                   {job.threads, report.wall_s}}));
  return report;
}

}  // namespace esi

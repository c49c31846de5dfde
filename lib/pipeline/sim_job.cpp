#include "esi/pipeline/sim_job.hpp"

#include <algorithm>
#include <array>
#include <ctime>

#include "esi/core/json_text.hpp"
#include "esi/core/version.hpp"
#include "esi/io/event_digest.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/io/output/output_folder.hpp"
#include "esi/io/output/run_manifest.hpp"
#include "esi/io/truth_tables.hpp"
#include "esi/pipeline/memory_limit.hpp"
#include "esi/pipeline/simulation/phase_counts.hpp"
#include "esi/pipeline/simulation/sim_output.hpp"
#include "esi/pipeline/stopwatch.hpp"

namespace esi {
namespace {

// A pixel's state, its light twice, and room for what writers gather; only absurd sizes come near any limit.
constexpr std::uint64_t kBytesPerPixel = 128;

bool is_file_of_simulation(std::string_view name) {
  constexpr std::array<std::string_view, 15> kNames = {
      "events.h5",         "events.aedat4", "events.txt", "images.txt",        "calib.txt",
      "ground_truth.json", "corners.csv",   "target.tum", "camera.tum",        "exposures.csv",
      "labels.u8",         "preview.mp4",   "run.json",   ".preview.part.mp4", "preview.mp4.timestamps.txt"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

bool is_folder_of_simulation(std::string_view name) {
  return name == "images" || name == "frames" || name == "clean";
}

constexpr FolderContent kSimulationContent{"a simulation", is_file_of_simulation, is_folder_of_simulation,
                                           false};

SimOptions with_poses(SimOptions options) {
  TrajectoryOptions& trajectory = options.trajectory;
  if (trajectory.kind == TrajectoryOptions::Kind::poses && !trajectory.poses.empty()) {
    for (const TrackPose& pose : read_track(trajectory.poses)) {
      const auto& [x, y, z, w] = pose.quaternion_xyzw;
      trajectory.pose_list.push_back(
          {pose.t_us, {rotation_of(normalized({x, y, z, w})), cv::Vec3d(pose.position_m.data())}});
    }
  }
  return options;
}

void require_memory_for(const SimOptions& options) {
  const SensorSize size = Camera(options.camera).size;
  require_memory(
      kBytesPerPixel * static_cast<std::uint64_t>(size.width_px) * static_cast<std::uint64_t>(size.height_px),
      "a sensor of " + to_string(size));
}

/// The processor time of all threads of this program.
double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One run: simulates, counts, and hands everything to the outputs.
class SimRun {
 public:
  SimRun(const SimJob& job, const SimConfig& config)
      : job_(job),
        config_(config),
        simulator_(with_poses(config.sim), job.threads),
        counts_(simulator_.phases()) {}

  SimReport run(const Observer& observer) {
    SinkOptions folder_options;
    folder_options.force = config_.output.force;
    OutputFolder folder(job_.output, folder_options, "", kSimulationContent);
    const auto outputs = open_sim_outputs(folder.path(), simulator_, config_);
    simulate(outputs, observer);
    report_.wall_s = watch_.seconds();
    if (report_.stopped) return report_;
    for (const auto& output : outputs) output->finish();
    folder.complete(json_text(manifest()));
    return report_;
  }

 private:
  void simulate(const std::vector<std::unique_ptr<SimOutput>>& outputs, const Observer& observer) {
    Packet packet;
    const auto duration_us = static_cast<double>(simulator_.end_us());
    while (!report_.stopped && simulator_.next(packet)) {
      const double before_s = cpu_s();
      for (const auto& output : outputs) output->take(simulator_, packet);
      digest_.add(packet.events);
      counts_.add(packet.events, simulator_.causes());
      writing_s_ += cpu_s() - before_s;
      report_.events = digest_.events();
      report_.intensity_frames += static_cast<std::int64_t>(packet.frames.size());
      report_.t_us = simulator_.t_us();
      const double fraction = static_cast<double>(report_.t_us) / duration_us;
      report_.stopped =
          observer && !observer({report_.events, report_.intensity_frames, report_.t_us, fraction});
    }
    simulating_s_ = cpu_s() - begun_s_ - writing_s_;
  }

  nlohmann::json events_json() const {
    const auto t_first_us = digest_.t_first_us();
    return {{"count", digest_.events()},
            {"on", digest_.on()},
            {"sum_x", digest_.sum_x()},
            {"sum_y", digest_.sum_y()},
            {"crc32", digest_.crc32()},
            {"t_first_us", t_first_us ? nlohmann::json(*t_first_us) : nlohmann::json()},
            {"duration_us", digest_.duration_us()}};
  }

  nlohmann::json run_json() const {
    const SensorSize size = simulator_.sensor_size();
    const double pixel_steps = static_cast<double>(simulator_.steps()) * size.width_px * size.height_px;
    nlohmann::json run = to_json(RunManifest::Run{job_.threads, report_.wall_s});
    run["cpu_simulating_s"] = simulating_s_;
    run["cpu_writing_s"] = writing_s_;
    run["ns_per_pixel_step"] = simulating_s_ / pixel_steps * 1e9;
    return run;
  }

  nlohmann::json manifest() const {
    const SensorSize size = simulator_.sensor_size();
    return {{"tool", job_.tool},
            {"version", version()},
            {"config", config_.json()},
            {"width", size.width_px},
            {"height", size.height_px},
            {"duration_us", simulator_.end_us()},
            {"steps", simulator_.steps()},
            {"events", events_json()},
            {"intensity_frames", report_.intensity_frames},
            {"phases", counts_.json()},
            {"run", run_json()}};
  }

  const Stopwatch watch_;
  const double begun_s_ = cpu_s();
  const SimJob& job_;
  const SimConfig& config_;
  Simulator simulator_;
  PhaseCounts counts_;
  EventDigest digest_;
  SimReport report_;
  double writing_s_ = 0.0;
  double simulating_s_ = 0.0;
};

}  // namespace

SimReport run_job(const SimJob& job, const SimConfig& config, const Observer& observer) {
  require_memory_for(config.sim);
  return SimRun(job, config).run(observer);
}

}  // namespace esi

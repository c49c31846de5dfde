#include <fmt/format.h>

#include "esi/io/output/output_file.hpp"
#include "esi/io/writing/recording_writer.hpp"
#include "esi/pipeline/simulation/sim_output.hpp"

namespace esi {
namespace {

/// As RPG's data sets have it: fx fy cx cy k1 k2 p1 p2 k3, in px.
std::string calibration_text(const Camera& camera) {
  return fmt::format("{} {} {} {} 0 0 0 0 0\n", camera.focal_px, camera.focal_px, camera.centre_px[0],
                     camera.centre_px[1]);
}

class RecordingOutput final : public SimOutput {
 public:
  RecordingOutput(const std::filesystem::path& path, SensorSize size)
      : writer_(open_recording_writer(path, {.size = size})), takes_frames_(holds_intensity_frames(path)) {}

  void take(const Simulator& /*simulator*/, const Packet& packet) override {
    if (takes_frames_ || packet.frames.empty()) return writer_->write(packet);
    Packet events_only;
    events_only.events = packet.events;
    writer_->write(events_only);
  }

  void finish() override { writer_->finish(); }

 private:
  std::unique_ptr<RecordingWriter> writer_;
  bool takes_frames_;
};

}  // namespace

std::unique_ptr<SimOutput> open_recording_output(const std::filesystem::path& folder,
                                                 const std::string& extension, const Simulator& simulator) {
  auto output = std::make_unique<RecordingOutput>(folder / ("events" + extension), simulator.sensor_size());
  if (extension == ".txt") {
    write_file(folder / "calib.txt", calibration_text(simulator.scenario().camera()));
  }
  return output;
}

}  // namespace esi

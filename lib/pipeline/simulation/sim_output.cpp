#include "esi/pipeline/simulation/sim_output.hpp"

#include <algorithm>

#include "esi/io/writing/recording_writer.hpp"

namespace esi {

std::vector<std::unique_ptr<SimOutput>> open_sim_outputs(const std::filesystem::path& folder,
                                                         const Simulator& simulator,
                                                         const SimConfig& config) {
  const SimOutputOptions& options = config.output;
  const std::vector<std::string> formats = options.formats();
  std::vector<std::unique_ptr<SimOutput>> outputs;
  outputs.reserve(formats.size() + 5);
  for (const std::string& format : formats) {
    outputs.push_back(open_recording_output(folder, "." + format, simulator));
  }
  if (config.sim.frames.intensity_frames) {
    const bool have_place = std::any_of(formats.begin(), formats.end(), [](const std::string& format) {
      return holds_intensity_frames("events." + format);
    });
    outputs.push_back(open_frames_output(folder, !have_place));
  }
  outputs.push_back(open_truth_output(folder, simulator, options));
  if (options.clean_frames) outputs.push_back(open_clean_output(folder, options.clean_fps));
  if (options.labels) outputs.push_back(open_label_output(folder));
  if (options.preview) {
    outputs.push_back(open_preview_output(folder, simulator.sensor_size(), options.preview_fps));
  }
  return outputs;
}

}  // namespace esi

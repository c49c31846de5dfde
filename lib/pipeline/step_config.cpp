#include "esi/pipeline/step_config.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/io/camera_calibration.hpp"
#include "esi/io/check/pixel_counts.hpp"
#include "esi/io/event_source.hpp"

namespace esi {
namespace {

std::vector<cv::Point> learn_hot_pixels(const std::filesystem::path& recording, const ReadOptions& read) {
  if (recording == "-") {
    throw usage_error("hot_pixels: standard input can't be read twice to learn them; give a list instead");
  }
  PixelCounts counts;
  Packet packet;
  for (const auto source = open_recording(recording, read); source->next(packet);) counts.add(packet.events);
  if (counts.gave_up()) {
    throw usage_error("hot_pixels: the sensor is too large to learn them; give a list instead");
  }
  std::vector<cv::Point> pixels;
  for (const HotPixel& hot : counts.hot_pixels()) pixels.emplace_back(hot.x, hot.y);
  return pixels;
}

std::vector<cv::Point> listed_hot_pixels(const std::string& list, SensorSize sensor) {
  auto pixels = parse_pixels(list);
  for (const cv::Point& pixel : pixels) {
    if (sensor.contains(pixel.x, pixel.y)) continue;
    throw usage_error(
        fmt::format("hot_pixels: {},{} lies outside the sensor of {}", pixel.x, pixel.y, to_string(sensor)));
  }
  return pixels;
}

std::string text_of(const std::vector<cv::Point>& pixels) {
  std::string text;
  for (const cv::Point& pixel : pixels) {
    text += fmt::format("{}{},{}", text.empty() ? "" : " ", pixel.x, pixel.y);
  }
  return text;
}

}  // namespace

void StepConfig::declare(OptionTable& table) {
  steps.declare(table);
  table.text("undistort", undistort,
             "make frames of a lens without distortion, by this calibration (OpenCV YAML or XML, calib.txt)");
}

bool StepConfig::any() const {
  return !steps.filters.hot_pixels.empty() || steps.filters.refractory_us > 0 ||
         steps.filters.background_us > 0 || steps.balance.balance || steps.smoothing.any() ||
         steps.range.range != Range::fixed || !undistort.empty();
}

void StepConfig::check() const { steps.range.check(); }

StepSurroundings surroundings_of(const StepConfig& config, const std::filesystem::path& recording,
                                 const ReadOptions& read, SensorSize sensor,
                                 const std::optional<Region>& region) {
  StepSurroundings surroundings;
  surroundings.size = region ? region->size : sensor;
  if (region) surroundings.corner = {region->x, region->y};
  if (!config.undistort.empty()) {
    surroundings.camera = read_camera_calibration(config.undistort);
    require_size(*surroundings.camera, sensor, config.undistort);
  }
  const EventFilterOptions& filters = config.steps.filters;
  surroundings.hot_pixels = filters.learns_hot_pixels() ? learn_hot_pixels(recording, read)
                                                        : listed_hot_pixels(filters.hot_pixels, sensor);
  return surroundings;
}

nlohmann::json steps_json(const StepConfig& config, const StepSurroundings& surroundings,
                          const RemovedEvents& removed) {
  const EventFilterOptions& filters = config.steps.filters;
  nlohmann::json json = {{"removed", nlohmann::json::object()}};
  if (!filters.hot_pixels.empty()) {
    json["hot_pixels"] = text_of(surroundings.hot_pixels);
    json["removed"]["hot_pixels"] = removed.hot_pixels;
  }
  if (filters.refractory_us > 0) json["removed"]["refractory"] = removed.refractory;
  if (filters.background_us > 0) json["removed"]["background"] = removed.background;
  return json;
}

}  // namespace esi

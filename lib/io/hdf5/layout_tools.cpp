#include "esi/io/hdf5/layout_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/core/error.hpp"

namespace esi {

bool has_columns(const Hdf5File& file, const Hdf5ColumnPaths& paths) {
  return file.has_dataset(paths.x) && file.has_dataset(paths.y) && file.has_dataset(paths.t) &&
         file.has_dataset(paths.p);
}

void refuse_stream(const Hdf5File& file, const ReadOptions& options) {
  if (options.stream.empty()) return;
  throw usage_error(fmt::format("{}: has only one event stream, not '{}'; leave --stream out", file.name(),
                                options.stream));
}

std::string choose_stream(const Hdf5File& file, const ReadOptions& options,
                          const std::vector<std::string>& present) {
  if (options.stream.empty() && present.size() == 1) return present.front();
  if (std::find(present.begin(), present.end(), options.stream) != present.end()) return options.stream;
  throw usage_error(fmt::format("{}: say with --stream which event stream is meant; there is {}", file.name(),
                                fmt::join(present, " and ")));
}

void use_sensor_size(double width_px, double height_px, const std::string& path, RecordingHeader& header) {
  const auto is_side = [](double side) {
    return side > 0 && side <= kMaxSensorSide_px && side == std::floor(side);
  };
  if (is_side(width_px) && is_side(height_px)) {
    header.sensor = SensorSize{static_cast<int>(width_px), static_cast<int>(height_px)};
  } else {
    header.notes.push_back(
        fmt::format("{} is no sensor size ({} x {}); it is not used", path, width_px, height_px));
  }
}

std::optional<SensorSize> expected_size(const ReadOptions& options, const RecordingHeader& header) {
  const auto given = options.sensor_size();
  return given ? given : header.sensor;
}

}  // namespace esi

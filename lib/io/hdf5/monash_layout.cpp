#include "esi/io/hdf5/attributes.hpp"
#include "esi/io/hdf5/layout_tools.hpp"
#include "esi/io/hdf5/monash_images.hpp"

namespace esi {
namespace {

const Hdf5ColumnPaths& new_names() {
  static const Hdf5ColumnPaths paths = {"/events/xs", "/events/ys", "/events/ts", "/events/ps",
                                        TimeColumn::seconds};
  return paths;
}

const Hdf5ColumnPaths& old_names() {
  static const Hdf5ColumnPaths paths = {"/events/x", "/events/y", "/events/ts", "/events/p",
                                        TimeColumn::seconds};
  return paths;
}

bool is_monash(const Hdf5File& file) {
  return has_columns(file, new_names()) || has_columns(file, old_names());
}

/// sensor_resolution: height, width.
void read_sensor(const Hdf5File& file, RecordingHeader& header) {
  const auto size = numeric_attribute(file, "/", "sensor_resolution", 2);
  if (!size) return;
  const double width_px = size->size() == 2 ? size->back() : 0;
  use_sensor_size(width_px, size->front(), "the attribute sensor_resolution", header);
}

Hdf5Content open_monash(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header) {
  refuse_stream(file, options);
  const Hdf5ColumnPaths& paths = has_columns(file, new_names()) ? new_names() : old_names();
  Hdf5Content content;
  content.events = std::make_unique<Hdf5Columns>(file, paths, 0, header.notes);
  read_sensor(file, header);
  auto images = std::make_unique<MonashImages>(file);
  header.has_intensity_frames = images->seconds(0).has_value();
  if (header.has_intensity_frames) {
    content.frames =
        std::make_unique<Hdf5FrameTrack>(std::move(images), expected_size(options, header), header.notes);
  }
  return content;
}

}  // namespace

constinit const Hdf5Layout kMonashLayout = {"Monash (event_utils)", "/events/{xs,ys,ts,ps}", is_monash,
                                            open_monash};

}  // namespace esi

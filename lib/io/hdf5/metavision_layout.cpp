#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/attributes.hpp"
#include "esi/io/hdf5/compound_events.hpp"
#include "esi/io/hdf5/layout_tools.hpp"

namespace esi {
namespace {

constexpr const char* kEvents = "/CD/events";

bool is_metavision(const Hdf5File& file) { return file.has_dataset(kEvents); }

/// geometry: "1280x720".
void read_sensor(const Hdf5File& file, RecordingHeader& header) {
  const auto geometry = text_attribute(file, "/", "geometry");
  if (!geometry) return;
  try {
    header.sensor = parse_sensor_size(*geometry);
  } catch (const Error&) {
    header.notes.push_back(
        fmt::format("the attribute geometry is no sensor size ({:?}); it is not used", *geometry));
  }
}

Hdf5Content open_metavision(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header) {
  refuse_stream(file, options);
  read_sensor(file, header);
  return {std::make_unique<CompoundEvents>(file, kEvents, header.notes), nullptr};
}

}  // namespace

constinit const Hdf5Layout kMetavisionLayout = {"Metavision", "/CD/events", is_metavision, open_metavision};

}  // namespace esi

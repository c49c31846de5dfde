#include "support/hdf5_recordings.hpp"

#include <algorithm>

#include "support/hdf5_file.hpp"
#include "support/hdf5_layouts.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {
namespace {

constexpr hsize_t kChunk = 256;
constexpr hsize_t kHeight_px = 180, kWidth_px = 240;

template <class Write>
std::string file_bytes(Write write) {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "recording.h5");
    write(file);
  }
  return content_of(folder / "recording.h5");
}

}  // namespace

std::string hdf5_recording(std::span<const Event> events) {
  Columns columns(0);
  for (const Event& event : events) {
    columns.x.push_back(event.x);
    columns.y.push_back(event.y);
    columns.t.push_back(event.t_us - 1000);
    columns.p.push_back(event.on ? 1 : 0);
  }
  return file_bytes([&](Hdf5Writer& file) {
    write_columns(file, "/events/", columns, {.chunk = kChunk, .filters = gzip});
    file.scalar("/t_offset", 1000);
  });
}

std::string mvsec_recording(std::span<const Event> events) {
  return file_bytes([&](Hdf5Writer& file) {
    write_mvsec(file, "/davis/left/events", mvsec_rows(events), kChunk);
    const std::vector<std::uint8_t> image(kHeight_px * kWidth_px, 128);
    const double time_s = events.empty() ? 0 : static_cast<double>(events.front().t_us) / 1e6;
    write_images(file, "/davis/left/", {1, kHeight_px, kWidth_px}, image, {time_s},
                 {1, kHeight_px, kWidth_px});
  });
}

std::string monash_recording(std::span<const Event> events) {
  return file_bytes([&](Hdf5Writer& file) {
    write_monash(file, events);
    write_attribute(file, "/", "sensor_resolution", {kHeight_px, kWidth_px});
  });
}

std::string metavision_hdf5_recording(std::span<const Event> events) {
  return file_bytes([&](Hdf5Writer& file) {
    write_metavision(file, events, kChunk);
    write_text_attribute(file, "/", "geometry", "240x180");
  });
}

}  // namespace esi::test

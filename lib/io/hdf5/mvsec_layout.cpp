#include "esi/core/error.hpp"
#include "esi/io/hdf5/layout_tools.hpp"
#include "esi/io/hdf5/mvsec_events.hpp"
#include "esi/io/hdf5/mvsec_images.hpp"

namespace esi {
namespace {

std::string group_of(const std::string& stream) { return "/davis/" + stream + "/"; }

std::vector<std::string> streams_of(const Hdf5File& file) {
  std::vector<std::string> present;
  for (const char* const stream : {"left", "right"}) {
    if (file.has_dataset(group_of(stream) + "events")) present.emplace_back(stream);
  }
  return present;
}

bool is_mvsec(const Hdf5File& file) { return !streams_of(file).empty(); }

/// The sensor's size is the images'.
std::unique_ptr<Hdf5FrameTrack> open_images(const Hdf5File& file, const std::string& group,
                                            const ReadOptions& options, RecordingHeader& header) {
  try {
    if (!file.has_dataset(group + "image_raw")) return nullptr;
    header.has_intensity_frames = true;
    auto images = std::make_unique<MvsecImages>(file, group + "image_raw", group + "image_raw_ts");
    header.sensor = images->size();
    return std::make_unique<Hdf5FrameTrack>(std::move(images), expected_size(options, header), header.notes);
  } catch (const Error& error) {
    return std::make_unique<Hdf5FrameTrack>(error.what(), header.notes);
  }
}

Hdf5Content open_mvsec(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header) {
  const std::string stream = choose_stream(file, options, streams_of(file));
  header.layout += ", " + stream;
  Hdf5Content content;
  content.events = std::make_unique<MvsecEvents>(file, group_of(stream) + "events", header.notes);
  content.frames = open_images(file, group_of(stream), options, header);
  return content;
}

}  // namespace

constinit const Hdf5Layout kMvsecLayout = {"MVSEC", "/davis/{left,right}/events", is_mvsec, open_mvsec};

}  // namespace esi

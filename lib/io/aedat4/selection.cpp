#include "esi/io/aedat4/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "esi/core/error.hpp"

namespace esi {
namespace {

bool is_events(const Aedat4Stream& stream) { return stream.type == "EVTS"; }

const Aedat4Stream& wanted_stream(const Aedat4Header& header, const std::string& wanted,
                                  const std::string& name) {
  int id = 0;
  const char* const end = wanted.data() + wanted.size();
  const auto [stop, error] = std::from_chars(wanted.data(), end, id);
  const Aedat4Stream* const stream = error == std::errc() && stop == end ? header.find(id) : nullptr;
  if (stream == nullptr || !is_events(*stream)) {
    throw usage_error(fmt::format(
        "{}: '{}' is none of its event streams; give --stream the number of a stream of type EVTS: {}", name,
        wanted, header.streams_text()));
  }
  return *stream;
}

const Aedat4Stream& only_stream(const Aedat4Header& header, const std::string& name) {
  const auto first = std::find_if(header.streams.begin(), header.streams.end(), is_events);
  if (first == header.streams.end()) {
    throw Error(fmt::format("{}: there is no event stream (type EVTS); its streams are {}", name,
                            header.streams_text()));
  }
  if (std::any_of(first + 1, header.streams.end(), is_events)) {
    throw usage_error(fmt::format(
        "{}: there are several event streams (type EVTS); choose one with --stream and its number: {}", name,
        header.streams_text()));
  }
  return *first;
}

/// Frames of another size than the sensor's come from another camera, whatever the header says.
bool is_of_same_camera(const Aedat4Stream& frames, const Aedat4Stream& events) {
  const bool fits = !frames.size || !events.size || *frames.size == *events.size;
  return fits && frames.source == events.source;
}

}  // namespace

Aedat4Selection select_aedat4_streams(const Aedat4Header& header, const std::string& wanted,
                                      const std::string& name) {
  const Aedat4Stream& events =
      wanted.empty() ? only_stream(header, name) : wanted_stream(header, wanted, name);
  Aedat4Selection selection{events, std::nullopt};
  const auto is_its_frames = [&](const Aedat4Stream& stream) {
    return stream.type == "FRME" && is_of_same_camera(stream, events);
  };
  const auto frames = std::find_if(header.streams.begin(), header.streams.end(), is_its_frames);
  if (frames != header.streams.end()) selection.frames = *frames;
  return selection;
}

}  // namespace esi

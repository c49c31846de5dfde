// What every format of the table promises, on the same events in each of its layouts.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_source.hpp"
#include "support/recordings.hpp"
#include "support/scripted_reader.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
namespace fs = std::filesystem;

namespace {

constexpr SensorSize kSensor{240, 180};

std::span<const std::byte> head_of(const std::string& content) {
  return std::as_bytes(std::span(content)).first(std::min(content.size(), kFormatHeadBytes));
}

ReadOptions with_size() {
  ReadOptions options;
  options.size = to_string(kSensor);
  return options;
}

/// Whether a file of that format tells where it ends, so that no cut goes unseen.
bool tells_its_end(std::string_view format) {
  return format == "aedat4" || format == "aedat3" || format == "hdf5" || format == "rosbag" ||
         format == "zip";
}

}  // namespace

TEST_CASE("every format is recognised by its first bytes, and by no other format before it") {
  for (const Format& format : formats()) {
    CAPTURE(format.name);
    const auto has_format = [&](const Encoder& encoder) { return encoder.format == format.name; };
    CHECK(std::any_of(encoders().begin(), encoders().end(), has_format));
  }
  for (const Encoder& encoder : encoders()) {
    if (encoder.format == "zip") continue;  // stands for what is in it
    CAPTURE(encoder.layout);
    const std::string content = encoder.encode(moving_edge(500));
    for (const Format& format : formats()) {
      CAPTURE(format.name);
      CHECK(format.recognises(head_of(content)) == (format.name == encoder.format));
    }
  }
}

TEST_CASE("the file's name makes no difference, nor does the layout: the same events come out") {
  const TempFolder folder;
  const auto expected = moving_edge(20000);
  for (const Encoder& encoder : encoders()) {
    CAPTURE(encoder.layout);
    const auto source = open_recording(folder.write("recording.bin", encoder.encode(expected)),
                                       encoder.has_sensor_size ? ReadOptions() : with_size());
    CHECK(source->sensor_size() == kSensor);
    CHECK(drain(*source).events == expected);
    CHECK_FALSE(source->losses().any());
    CHECK(source->header().format == (encoder.format == "zip" ? "text" : encoder.format));
  }
}

TEST_CASE("events come in packets of bounded size, and nothing comes after the end") {
  const TempFolder folder;
  for (const Encoder& encoder : encoders()) {
    CAPTURE(encoder.layout);
    const auto source =
        open_recording(folder.write("recording", encoder.encode(moving_edge(50000))), with_size());
    Packet packet;
    while (source->next(packet)) CHECK(packet.events.size() < 20 * kPacketEvents);
    CHECK(packet.events.empty());
    CHECK_FALSE(source->next(packet));
  }
}

TEST_CASE("a recording that is cut gives the events before the cut, or an error, and counts the loss") {
  const TempFolder folder;
  const auto whole = moving_edge(5000);
  for (const Encoder& encoder : encoders()) {
    const std::string content = encoder.encode(whole);
    for (const double share : {0.0, 0.001, 0.01, 0.1, 0.33, 0.5, 0.71, 0.86, 0.95, 0.99}) {
      const auto bytes = static_cast<std::size_t>(share * static_cast<double>(content.size()));
      CAPTURE(encoder.layout, bytes);
      const fs::path cut = folder.write("cut", content.substr(0, bytes));
      try {
        const auto source = open_recording(cut, with_size());
        const auto events = drain(*source).events;
        const auto known = std::min(events.size(), whole.size());
        CHECK(std::equal(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(known), whole.begin()));
        CHECK(events.size() <= whole.size());
        if (tells_its_end(encoder.format)) CHECK((source->losses().any() || events.size() == whole.size()));
      } catch (const Error& error) {
        CHECK(std::string(error.what()).find("cut") != std::string::npos);  // names the file
      }
    }
  }
}

TEST_CASE("no format recognises nothing, noise, or another program's files") {
  const std::string text =
      GENERATE(std::string(), std::string(1, '\0'), std::string("\x89PNG\r\n\x1a\n\0\0", 10),
               std::string("PK\x03\x04"), std::string("\x1f\x8b\x08"), std::string("\xff\xfe t\0x\0", 8));
  for (const Format& format : formats()) {
    CAPTURE(format.name);
    CHECK_FALSE(format.recognises(std::as_bytes(std::span(text))));
  }
}

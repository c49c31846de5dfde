// What every format of the table promises, on the sample that data-samples has of it.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_source.hpp"
#include "support/scripted_reader.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
namespace fs = std::filesystem;

namespace {

fs::path sample_of(const Format& format) {
  const std::string extensions(format.extensions);
  return source_dir() / "data-samples" / ("moving_tag" + extensions.substr(0, extensions.find(' ')));
}

std::span<const std::byte> head_of(const std::string& content) {
  return std::as_bytes(std::span(content)).first(std::min(content.size(), kFormatHeadBytes));
}

ReadOptions with_size() {
  ReadOptions options;
  options.size = "240x180";
  options.time_zero = TimeZero::first_event;
  return options;
}

/// The events before t_end_us, read in packets.
std::vector<Event> events_before(const fs::path& path, std::int64_t t_end_us) {
  std::vector<Event> events = drain(*open_recording(path, with_size())).events;
  std::erase_if(events, [t_end_us](const Event& event) { return event.t_us >= t_end_us; });
  return events;
}

}  // namespace

TEST_CASE("every format has a sample, which it recognises and no other format before it does") {
  for (const Format& format : formats()) {
    CAPTURE(format.name);
    REQUIRE(fs::exists(sample_of(format)));
    const std::string content = content_of(sample_of(format));
    const auto first = std::find_if(formats().begin(), formats().end(),
                                    [&](const Format& f) { return f.recognises(head_of(content)); });
    REQUIRE(first != formats().end());
    CHECK(first->name == format.name);
    CHECK(open_recording(sample_of(format), with_size())->header().format == format.name);
  }
}

TEST_CASE("the first bytes decide the format, not the name") {
  const TempFolder folder;
  for (const Format& format : formats()) {
    const fs::path misnamed = folder / "recording.bin";
    fs::copy_file(sample_of(format), misnamed, fs::copy_options::overwrite_existing);
    CHECK(open_recording(misnamed, with_size())->header().format == format.name);
  }
}

TEST_CASE("every format gives the same events of the same recording") {
  constexpr std::int64_t kShortest_us = 250000;  // all samples are longer
  const auto expected = events_before(sample_of(formats().front()), kShortest_us);
  REQUIRE(expected.size() > 50000);
  for (const Format& format : formats()) {
    CAPTURE(format.name);
    CHECK(events_before(sample_of(format), kShortest_us) == expected);
  }
}

TEST_CASE("events come sorted, inside the sensor, in packets of bounded size") {
  for (const Format& format : formats()) {
    CAPTURE(format.name);
    const auto source = open_recording(sample_of(format), with_size());
    const SensorSize size = require_sensor_size(*source, "sample");
    Packet packet;
    std::int64_t t_us = INT64_MIN;
    bool good = true;
    while (source->next(packet)) {
      CHECK(packet.events.size() < 20 * kPacketEvents);
      for (const Event& event : packet.events) {
        good = good && event.t_us >= t_us && size.contains(event.x, event.y);
        t_us = event.t_us;
      }
    }
    CHECK(good);
    CHECK_FALSE(source->losses().any());
    CHECK(packet.events.empty());
    CHECK_FALSE(source->next(packet));
  }
}

TEST_CASE(
    "a recording that is cut anywhere gives the events before the cut, or an error, and counts the loss") {
  const TempFolder folder;
  for (const Format& format : formats()) {
    const std::string content = content_of(sample_of(format));
    const auto whole = drain(*open_recording(sample_of(format), with_size())).events;
    for (const double share : {0.0, 0.0001, 0.01, 0.33, 0.71, 0.95}) {
      const auto bytes = static_cast<std::size_t>(share * static_cast<double>(content.size()));
      CAPTURE(format.name, bytes);
      const fs::path cut = folder.write("cut", content.substr(0, bytes));
      try {
        const auto source = open_recording(cut, with_size());
        const auto events = drain(*source).events;
        CHECK(events.size() < whole.size());
        CHECK(std::equal(events.begin(), events.end(), whole.begin()));
        const bool ends_with_a_line = bytes > 0 && content[bytes - 1] == '\n';
        CHECK((source->losses().any() || (format.name == "text" && ends_with_a_line) ||
               events.size() + 1 == whole.size()));
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

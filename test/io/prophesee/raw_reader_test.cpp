#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/prophesee/raw_reader.hpp"
#include "support/prophesee_file.hpp"
#include "support/random_events.hpp"
#include "support/read_format.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

const std::string kEvt3Words = words16({0x8001, 0x6002, 0x0003, 0x2804});
const std::vector<Event> kEvt3Events = {{4098, 4, 3, true}};

FormatReading read_raw(const std::string& bytes) { return read_bytes_with(open_prophesee_raw, bytes); }

std::string raw_error(const std::string& bytes) {
  try {
    read_raw(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("RAW headers of every kind give encoding and sensor size") {
  struct Row {
    std::vector<std::string> lines;
    std::optional<SensorSize> sensor;
    const char* note;
  };
  const std::optional<SensorSize> none;
  const auto row = GENERATE_COPY(
      Row{{"Date 2020-09-25 07:48:29", "evt 3.0", "plugin_name hal", "system_ID 48"},
          SensorSize{1280, 720},
          "system_ID 48"},
      Row{{"system_ID 21", "evt 3.0"}, SensorSize{640, 480}, "system_ID 21"},
      Row{{"system_ID 999", "evt 3.0"}, none, ""}, Row{{"evt 3.0"}, none, ""},
      Row{{"evt 3.0", "end"}, none, ""},
      Row{{"format EVT3;height=720;width=1280", "geometry 1280x720", "end"}, SensorSize{1280, 720}, ""},
      Row{{"format EVT3;width=320;height=200", "system_ID 21"}, SensorSize{320, 200}, ""},
      Row{{"geometry 1x65536", "format EVT3"}, SensorSize{1, 65536}, ""},
      Row{{"geometry 0x480", "evt 3.0"}, none, ""}, Row{{"geometry 640x65537", "evt 3.0"}, none, ""},
      Row{{"geometry -640x480", "evt 3.0"}, none, ""}, Row{{"geometry 640", "evt 3.0"}, none, ""},
      Row{{"geometry 99999999999x480", "evt 3.0", "system_ID 21"}, SensorSize{640, 480}, "system_ID"},
      Row{{"evt 2.0", "format EVT3"}, none, ""},
      Row{{"integrator_name Proph\xC3\xA9see", "evt 3.0"}, none, ""}, Row{{"evt 3.0\r", "end\r"}, none, ""});
  CAPTURE(row.lines);
  const FormatReading reading = read_raw(prophesee_lines(row.lines) + kEvt3Words);
  CHECK(reading.all.events == kEvt3Events);
  CHECK(reading.header.sensor == row.sensor);
  CHECK(reading.header.format == "prophesee-raw");
  CHECK(reading.header.layout == "Prophesee RAW, EVT3");
  CHECK_FALSE(reading.header.has_packets);
  CHECK_THAT(reading.notes(), Contains(row.note));
  CHECK(reading.notes().empty() == (*row.note == '\0'));
  CHECK(reading.losses.text().empty());
}

TEST_CASE("RAW data may begin with the sign that header lines begin with") {
  const auto [what, data] = GENERATE(table<const char*, std::string>({
      {"no blank", words16({0x3025, 0x0A61})},
      {"no letter", words16({0x2025, 0x0A31})},
      {"no text", words16({0x2025, 0x0161, 0x0A31})},
      {"no end", words16({0x2025, 0x6161})},
      {"a byte that UTF-8 has not", words16({0x2025, 0xFF61, 0x0A31})},
      {"only the sign", words16({0x0025})},
      {"a blank line", "% \n" + std::string(1, '\x60')},
  }));
  CAPTURE(what);
  const FormatReading reading = read_raw(prophesee_lines({"evt 3.0"}) + data + kEvt3Words);
  const FormatReading marked = read_raw(prophesee_lines({"evt 3.0", "end"}) + data + kEvt3Words);
  CHECK(reading.all.events == marked.all.events);
  CHECK(reading.notes() == marked.notes());
  CHECK(reading.all.events.back() == kEvt3Events.back());
  CHECK(reading.losses.text().empty());
  // With the mark, even what looks like a line is data: 0x2025 and 0x6120 come before the first time.
  const FormatReading like_a_line = read_raw(prophesee_lines({"evt 3.0", "end"}) + "% abcd\n " + kEvt3Words);
  CHECK(like_a_line.all.events == kEvt3Events);
  CHECK_THAT(like_a_line.notes(), Contains("2 events before"));
}

TEST_CASE("a RAW file whose encoding is not known is refused by name") {
  const auto [line, message] = GENERATE(table<const char*, const char*>({
      {"evt 4.0", "encoded as '4.0'"},
      {"format HISTO3D;height=320;width=320", "encoded as 'HISTO3D'"},
      {"format EVT4", "encoded as 'EVT4'"},
      {"evt", "encoded as ''"},
      {"plugin_name hal_plugin_gen3_fx3", "neither a line \"% evt\" nor \"% format\""},
  }));
  CAPTURE(line);
  CHECK_THAT(raw_error(prophesee_lines({line, "end"}) + kEvt3Words),
             Contains(message) && Contains("recording:"));
}

TEST_CASE("each RAW encoding gives back its events") {
  const auto events = random_events({0, 0, 240, 180}, 30000, 40, 3);
  const auto [layout, bytes] =
      GENERATE_COPY(table<std::string, std::string>({{"Prophesee RAW, EVT2", evt2_recording(events)},
                                                     {"Prophesee RAW, EVT21", evt21_recording(events)},
                                                     {"Prophesee RAW, EVT3", evt3_recording(events)}}));
  const FormatReading reading = read_raw(bytes);
  CHECK(reading.all.events == events);
  CHECK(reading.header.layout == layout);
  CHECK(reading.header.sensor == SensorSize{240, 180});
  CHECK(reading.losses.text().empty());
  CHECK(reading.most_events_at_once < 3 * kPacketEvents);
  CHECK(looks_like_prophesee_raw(std::as_bytes(std::span(bytes)).first(200)));
}

TEST_CASE("legacy EVT2.1 is told by the format or by a line of its own") {
  const std::vector<std::string> lines =
      GENERATE(std::vector<std::string>{"format EVT21;endianness=legacy;height=180;width=240"},
               std::vector<std::string>{"evt 2.1", "endianness legacy"});
  const std::uint64_t event = evt21_word(1, 5, 32, 7, 0x10);
  const FormatReading reading = read_raw(
      prophesee_lines(lines) + words64({halves_exchanged(evt21_time_high(640)), halves_exchanged(event)}));
  CHECK(reading.all.events == std::vector<Event>{{645, 36, 7, true}});
}

TEST_CASE("RAW events without a time are said, and an error where there are no others") {
  const std::string header = prophesee_lines({"evt 2.0"});
  const FormatReading reading =
      read_raw(header + words32({0x1000'0001, 0x1000'0002, 0x8000'0001, 0x1000'0003}));
  CHECK(reading.all.events == std::vector<Event>{{64, 0, 3, true}});
  CHECK_THAT(reading.notes(), Contains("2 events before the first time word"));
  CHECK(reading.losses.text().empty());
  CHECK_THAT(raw_error(header + words32({0x1000'0001, 0x1000'0002})), Contains("its 2 events have no time"));
  CHECK(read_raw(header).all.events.empty());
}

}  // namespace esi::test

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_digest.hpp"
#include "io/text/read_text.hpp"
#include "support/shared_data.hpp"

namespace esi::test {
namespace {

using Events = std::vector<Event>;

// Three events, 3.5 s apart, as in every way of writing them below.
const Events kThree = {{1500000, 219, 244, false}, {1500001, 249, 254, true}, {5000000, 7, 0, true}};

ReadOptions with_columns(const std::string& columns) {
  ReadOptions options;
  options.columns = columns;
  return options;
}

}  // namespace

TEST_CASE("Every dialect of text gives the same events") {
  struct Row {
    const char* text;
    const char* layout;
    ReadOptions options = {};
  };
  const ReadOptions ms = in_unit(TimeUnit::milliseconds), s = in_unit(TimeUnit::seconds);
  const ReadOptions ns = in_unit(TimeUnit::nanoseconds), us = in_unit(TimeUnit::microseconds);
  const Row row = GENERATE_COPY(values<Row>({
      // RPG
      {"1.500000 219 244 0\n1.500001 249 254 1\n5.000000 7 0 1\n", "text, columns t,x,y,p"},
      {"1.5 219 244 0\n1.500001000000000 249 254 1\n5 7 0 1", "text, columns t,x,y,p"},
      {"1.5\t219\t244\t0\n1.500001\t249\t254\t1\n5.0\t7\t0\t1\n", "text, columns t,x,y,p"},
      {"1.5\t219 244 0\n  1.500001   249\t\t254 1 \n5.0\t7\t0\t1\n", "text, columns t,x,y,p"},
      {"1.5 219 244 0\r\n1.500001 249 254 1\r\n5.0 7 0 1\r\n", "text, columns t,x,y,p"},
      {"\xEF\xBB\xBF"
       "1.5 219 244 0\n1.500001 249 254 1\n5.0 7 0 1\n",
       "text, columns t,x,y,p"},
      {"# a comment\n\n1.5 219 244 0\n# and one within\n1.500001 249 254 1\n\n5.0 7 0 1\n",
       "text, columns t,x,y,p"},
      {"1.5 219 244 -1\n1.500001 249 254 1\n5.0 7 0 1\n", "text, columns t,x,y,p"},
      {"1.5 219 244 1\n1.500001 249 254 2\n5.0 7 0 2\n", "text, columns t,x,y,p"},
      {"1.500000000000000000e+00 2.190000000000000000e+02 2.440000000000000000e+02 0.000000000000000000e+00\n"
       "1.500001000000000000e+00 2.490000000000000000e+02 2.540000000000000000e+02 1.000000000000000000e+00\n"
       "5.000000000000000000e+00 7.000000000000000000e+00 0.000000000000000000e+00 "
       "1.000000000000000000e+00\n",
       "text, columns t,x,y,p"},
      {"+1.5 219 244 0\n+1.500001 +249 254 +1\n+5.0 7 0 1\n", "text, columns t,x,y,p"},
      // csv
      {"t,x,y,p\n1500000,219,244,0\n1500001,249,254,1\n5000000,7,0,1\n", "csv, columns t,x,y,p"},
      {"1500000,219,244,0\n1500001,249,254,1\n5000000,7,0,1\n", "csv, columns t,x,y,p"},
      {"1500000, 219, 244, 0\n1500001 ,249 ,254 ,1\n5000000,7,0,1\n", "csv, columns t,x,y,p"},
      {"Timestamp,X,Y,Polarity\r\n1500000,219,244,0\r\n1500001,249,254,1\r\n5000000,7,0,1\r\n",
       "csv, columns t,x,y,p"},
      {"p,y,t,x\n0,244,1500000,219\n1,254,1500001,249\n1,0,5000000,7\n", "csv, columns p,y,t,x"},
      {"x y pol ts\n219 244 0 1500000\n249 254 1 1500001\n7 0 1 5000000\n", "text, columns x,y,p,t"},
      {"# x y t p\n219 244 1.5 0\n249 254 1.500001 1\n7 0 5.0 1\n", "text, columns x,y,t,p"},
      {"# t x y p\nX,Y,P,T\n219,244,0,1500000\n249,254,1,1500001\n7,0,1,5000000\n", "csv, columns x,y,p,t"},
      {"# t x y p\n346 260\n1.5 219 244 0\n1.500001 249 254 1\n5.0 7 0 1\n", "text, columns t,x,y,p"},
      {"t_ns,x,y,p\n1500000000,219,244,0\n1500000999,249,254,1\n5000000000,7,0,1\n", "csv, columns t,x,y,p"},
      {"time_ms,x,y,p\n1500,219,244,0\n1500.001,249,254,1\n5000,7,0,1\n", "csv, columns t,x,y,p"},
      {",t,x,y,p,label\n0,1500000,219,244,0,noise\n1,1500001,249,254,1,\n2,5000000,7,0,1,a b\n",
       "csv, columns -,t,x,y,p,-"},
      // Metavision
      {"%geometry:346,260\n219,244,0,1500000\n249,254,1,1500001\n7,0,1,5000000\n", "csv, columns x,y,p,t"},
      {"219,244,0,1500000\n249,254,1,1500001\n7,0,1,5000000\n", "csv, columns x,y,p,t"},
      // said by an option
      {"244 219 0 1.5\n254 249 1 1.500001\n0 7 1 5.0\n", "text, columns y,x,p,t", with_columns("yxpt")},
      {"a,b,c,d\n244,219,0,1500000\n254,249,1,1500001\n0,7,1,5000000\n", "csv, columns y,x,p,t",
       with_columns("yxpt")},
      {"t,x,y,p\n219,244,0,1500000\n249,254,1,1500001\n7,0,1,5000000\n", "csv, columns x,y,p,t",
       with_columns("xypt")},
      {"1500 219 244 0\n1500.001 249 254 1\n5e3 7 0 1\n", "text, columns t,x,y,p", ms},
      {"1500000000 219 244 0\n1500001499 249 254 1\n5000000000 7 0 1\n", "text, columns t,x,y,p", ns},
      {"1500000 219 244 0\n1500000.5 249 254 1\n5000000 7 0 1\n", "text, columns t,x,y,p", us},
      {"1.5 219 244 0\n1.500001 249 254 1\n5 7 0 1\n", "text, columns t,x,y,p", s},
  }));
  INFO(row.text);
  const TextContent content = read_text(row.text, row.options);
  CHECK(content.events == kThree);
  CHECK(content.header.format == "text");
  CHECK(content.header.layout == row.layout);
  CHECK(content.losses.text().empty());
}

TEST_CASE("A sensor size is taken from where a text gives one") {
  struct Row {
    const char* text;
    std::optional<SensorSize> expected;
  };
  const Row row = GENERATE(values<Row>({
      {"346 260\n0.1 1 2 1\n0.2 1 2 0\n", SensorSize{346, 260}},
      {"# made by hand\r\n346\t260\r\n0.1 1 2 1\r\n0.2 1 2 0\r\n", SensorSize{346, 260}},
      {"346,260\n100000,1,2,1\n200000,1,2,0\n", SensorSize{346, 260}},
      {"%geometry:346,260\n1,2,1,100000\n1,2,0,200000\n", SensorSize{346, 260}},
      {"% geometry: 346x260\n% and more\n1,2,1,100000\n1,2,0,200000\n", SensorSize{346, 260}},
      {"0.1 1 2 1\n0.2 1 2 0\n", std::nullopt},
  }));
  INFO(row.text);
  const TextContent content = read_text(row.text);
  CHECK(content.header.sensor == row.expected);
  CHECK(content.events == Events{{100000, 1, 2, true}, {200000, 1, 2, false}});
}

TEST_CASE("What was assumed about a text is said") {
  struct Row {
    const char* text;
    std::vector<const char*> notes;
  };
  const Row row = GENERATE(values<Row>({
      {"0.1 1 2 1\n0.2 1 2 0\n", {"t, x, y, p", "seconds", "0/1"}},
      {"1,2,-1,100000\n1,2,1,200000\n", {"x, y, p, t", "microseconds", "-1/1"}},
      {"t_us,x,y,p\n100000,1,2,1\n200000,1,2,2\n", {"2 is ON"}},
      {"0.1 1 2 1\n0.2 1 2 1\n", {"1 only"}},
      {"t,x,y,p,label\n100000,1,2,1,7\n200000,1,2,0,7\n", {"ignored"}},
      {"4294967295 1 2 1\n100000 1 2 0\n", {"32-bit clock wraps (first at line 2)"}},
  }));
  INFO(row.text);
  const std::string notes = read_text(row.text).notes();
  for (const char* const note : row.notes) CHECK_THAT(notes, Catch::Contains(note));
}

TEST_CASE("A given unit and named columns leave nothing to assume") {
  ReadOptions options = in_unit(TimeUnit::microseconds);
  options.columns = "txyp";
  options.polarity = PolarityCode::zero_one;
  CHECK(read_text("100 1 2 1\n200 1 2 0\n", options).notes().empty());
}

TEST_CASE("A polarity code is settled by the first value that tells, wherever it stands") {
  std::string ones;
  for (int i = 0; i < 30000; ++i) ones += fmt::format("{} 1 2 1\n", 1000 * i);
  const char* const off = GENERATE("0", "-1");
  const TextContent content =
      read_text(ones + "30000000 1 2 " + off + "\n30001000 1 2 1\n30002000 1 2 " + off + "\n");
  REQUIRE(content.events.size() == 30003);
  CHECK(std::all_of(content.events.begin(), content.events.end() - 3, [](const Event& e) { return e.on; }));
  CHECK_FALSE(content.events[30000].on);
  CHECK(content.events[30001].on);
  CHECK_FALSE(content.events[30002].on);
  CHECK(content.losses.text().empty());
}

TEST_CASE("A polarity code that is given is taken, whatever the first lines look like") {
  ReadOptions options;
  options.polarity = PolarityCode::one_two;
  const Events events = read_text("0.1 1 2 1\n0.2 1 2 1\n", options).events;
  CHECK(events == Events{{100000, 1, 2, false}, {200000, 1, 2, false}});
}

TEST_CASE("Times that go back do not make another column the time") {
  // x rises all the time, but that is what x may do.
  const Events events = read_text("0.2 1 2 1\n0.1 3 4 0\n0.3 5 6 1\n").events;
  CHECK(events == Events{{200000, 1, 2, true}, {100000, 3, 4, false}, {300000, 5, 6, true}});
}

TEST_CASE("Events come in the order of the file, with their own times, in packets of bounded size") {
  std::string text;
  Events expected;
  for (int i = 0; i < 50000; ++i) {
    const int t_us = 20 * i - (i % 50 == 0 ? 15 : 0) - (i % 7 == 0 ? 500000 : 0);
    text += fmt::format("{} {} {} {}\n", t_us, i % 346, i % 260, i % 3 == 0 ? 0 : 1);
    expected.push_back(
        {t_us, static_cast<std::uint16_t>(i % 346), static_cast<std::uint16_t>(i % 260), i % 3 != 0});
  }
  const TextContent content = read_text(text);
  CHECK(content.events == expected);
  CHECK(content.most_events_at_once <= kPacketEvents + 1);
}

TEST_CASE("A counter that wraps is unwrapped in a long text") {
  std::string text;
  Events expected;
  const std::int64_t period = GENERATE(std::int64_t{1} << 31, std::int64_t{1} << 32);
  for (std::int64_t i = 0; i < 40000; ++i) {
    const std::int64_t t_us = 3 * period / 4 + i * (period / 10000);
    text += fmt::format("{} 5 6 {}\n", t_us % period, i % 2);
    expected.push_back({t_us, 5, 6, i % 2 == 1});
  }
  CHECK(read_text(text).events == expected);
}

TEST_CASE("Every real text recording has the digest that other parsers found") {
  const auto digests = shared_data("digests.json");
  if (!digests) return;
  std::ifstream file(*digests);
  const auto all = nlohmann::json::parse(file);
  int recordings = 0;
  for (const auto& [name, expected] : all.items()) {
    if (!name.ends_with(".txt") && !name.ends_with(".csv")) continue;
    const auto path = shared_data(name);
    if (!path) continue;
    INFO(name);
    ++recordings;
    const TextContent content = read_text_path(*path);
    EventDigest digest;
    digest.add(content.events);
    CHECK(digest.events() == expected.at("events"));
    CHECK(digest.duration_us() == expected.at("duration_us"));
    CHECK(digest.sum_x() == expected.at("sum_x"));
    CHECK(digest.sum_y() == expected.at("sum_y"));
    CHECK(digest.on() == expected.at("on"));
    CHECK(digest.crc32() == expected.at("crc32"));
    CHECK(digest.t_first_us() == expected.value("t_first_us", std::int64_t{0}));
    CHECK(content.losses.text().empty());
  }
  CHECK(recordings == 6);
}

}  // namespace esi::test

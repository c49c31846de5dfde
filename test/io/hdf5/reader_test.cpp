#include "esi/io/hdf5/reader.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "esi/io/event_digest.hpp"
#include "support/read_hdf5.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;

TEST_CASE("The HDF5 files of the tag board have the digests of independent parsers") {
  const auto digests_path = shared_data("digests.json");
  if (!digests_path) return;
  const auto digests = nlohmann::json::parse(std::ifstream(*digests_path));
  const std::vector<std::pair<std::string, std::string>> files = {
      {"tagboard/tagboard.dsec_blosc.h5", "DSEC, TUM-VIE"},
      {"tagboard/tagboard.dsec_gzip.h5", "DSEC, TUM-VIE"},
      {"tagboard/tagboard.e2calib_eds_lzf.h5", "EDS, e2calib"},
      {"tagboard/tagboard.m3ed_lzf.h5", "M3ED, left"},
  };
  for (const auto& [name, layout] : files) {
    const auto path = shared_data(name);
    if (!path) continue;
    INFO(name);
    const Reading reading = read_hdf5(*path);
    EventDigest digest;
    digest.add(reading.events);
    const nlohmann::json& truth = digests.at(name);
    CHECK(digest.events() == truth.at("events").get<std::int64_t>());
    CHECK(digest.duration_us() == truth.at("duration_us").get<std::int64_t>());
    CHECK(digest.sum_x() == truth.at("sum_x").get<std::int64_t>());
    CHECK(digest.sum_y() == truth.at("sum_y").get<std::int64_t>());
    CHECK(digest.on() == truth.at("on").get<std::int64_t>());
    CHECK(digest.crc32() == truth.at("crc32").get<std::string>());
    CHECK(reading.header.layout == layout);
    CHECK(reading.header.notes.empty());
    CHECK_FALSE(reading.losses.any());
    const bool is_m3ed = layout.starts_with("M3ED");
    CHECK(reading.header.sensor == (is_m3ed ? std::optional(SensorSize{346, 260}) : std::nullopt));
    // The original's first event, from the README; t_offset has it, e2calib's times have it themselves.
    CHECK(reading.events.front().t_us == (is_m3ed ? 0 : 1744227144732712));
  }
}

TEST_CASE("HDF5 columns may have any integer type") {
  const TempFolder folder;
  Columns columns(300);
  for (auto* column : {&columns.x, &columns.y, &columns.t}) {
    for (std::int64_t& value : *column) value %= 100;  // What the narrowest type holds.
  }
  for (const hid_t type : {H5T_STD_I8LE, H5T_STD_U8BE, H5T_STD_I16BE, H5T_STD_U16LE, H5T_STD_I32LE,
                           H5T_STD_U32BE, H5T_STD_I64BE, H5T_STD_U64LE}) {
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/events/", columns, {.type = type});
    }
    CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
  }
}

TEST_CASE("HDF5 integers of 24 bits keep their sign") {
  const TempFolder folder;
  const hid_t type = H5Tcopy(H5T_STD_I32BE);
  H5Tset_size(type, 3);
  Columns columns(5);
  columns.t = {-8388608, -1, 0, 1, 8388607};
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns, {.type = type});
  }
  H5Tclose(type);
  CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
}

TEST_CASE("The whole range of HDF5 times arrives unclipped") {
  const TempFolder folder;
  Columns columns(3);
  columns.t = {std::numeric_limits<std::int64_t>::min(), -1, std::numeric_limits<std::int64_t>::max() - 1};
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns);
  }
  CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
}

TEST_CASE("HDF5 polarity: above 0 is ON, and booleans are taken") {
  const TempFolder folder;
  Columns columns(4);
  columns.p = {-1, 1, 0, 1};
  const hid_t boolean = H5Tenum_create(H5T_STD_I8LE);
  const std::int8_t off = 0;
  const std::int8_t on = 1;
  H5Tenum_insert(boolean, "FALSE", &off);
  H5Tenum_insert(boolean, "TRUE", &on);
  {
    Hdf5Writer file(folder / "signed.h5");
    write_columns(file, "/", columns, {.type = H5T_STD_I64LE});
    Hdf5Writer enumerated(folder / "boolean.h5");
    write_columns(enumerated, "/", columns);
    enumerated.remove("/p");
    const std::int8_t values[] = {0, 1, 0, 1};
    enumerated.dataset("/p", {4}, {.type = boolean}, boolean, values);
  }
  H5Tclose(boolean);
  for (const char* const name : {"signed.h5", "boolean.h5"}) {
    const Reading reading = read_hdf5(folder / name);
    CHECK(reading.events == expected_events(columns));
    CHECK(reading.header.notes.empty());
  }
}

TEST_CASE("Other HDF5 polarities are said, once") {
  const TempFolder folder;
  Columns columns(20000);
  columns.p[9000] = columns.p[19000] = 2;
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns);
  }
  const Reading reading = read_hdf5(folder / "a.h5");
  REQUIRE(reading.header.notes.size() == 1);
  CHECK_THAT(reading.header.notes[0], Catch::Contains("dataset /p, row 9000: polarity 2"));
}

TEST_CASE("t_offset is added to HDF5 times") {
  const TempFolder folder;
  Columns columns(100);
  for (const bool is_array : {false, true}) {
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/events/", columns);
      is_array ? file.column("/t_offset", {1744227144732712}) : file.scalar("/t_offset", 1744227144732712);
    }
    Columns shifted = columns;
    for (std::int64_t& t : shifted.t) t += 1744227144732712;
    CHECK(read_hdf5(folder / "a.h5").events == expected_events(shifted));
  }
}

TEST_CASE("HDF5 coordinates that 16 bits can't hold are counted as outside") {
  const TempFolder folder;
  Columns columns(20000);
  columns.x[0] = -1;
  columns.x[9000] = 65536;
  columns.y[9001] = std::int64_t{1} << 40;
  columns.y[19999] = 65535;
  // What 32 bits would make a small number of.
  columns.x[9002] = -(std::int64_t{1} << 32) + 5;
  columns.y[9003] = (std::int64_t{1} << 32) + 5;
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns);
  }
  const Reading reading = read_hdf5(folder / "a.h5");
  std::vector<Event> expected = expected_events(columns, 1, 9000);
  const std::vector<Event> rest = expected_events(columns, 9004, 20000);
  expected.insert(expected.end(), rest.begin(), rest.end());
  CHECK(reading.events == expected);
  CHECK(reading.losses.of(Drop::outside_sensor) == 5);
}

TEST_CASE("M3ED: --stream chooses the camera, and is asked for only where there are two") {
  const TempFolder folder;
  const Columns left(50);
  const Columns right(70);
  {
    Hdf5Writer file(folder / "both.h5");
    write_columns(file, "/prophesee/left/", left);
    write_columns(file, "/prophesee/right/", right);
    file.column("/prophesee/right/calib/resolution", {1280, 720});
    Hdf5Writer one(folder / "one.h5");
    write_columns(one, "/prophesee/right/", right);
    one.column("/prophesee/right/calib/resolution", {0, 720});
  }
  ReadOptions options;
  CHECK_THAT(hdf5_error(folder / "both.h5", options, Error::Kind::usage),
             Catch::Contains("--stream") && Catch::Contains("left and right"));
  options.stream = "left";
  CHECK(read_hdf5(folder / "both.h5", options).events == expected_events(left));
  CHECK_FALSE(read_hdf5(folder / "both.h5", options).header.sensor);
  CHECK_THAT(hdf5_error(folder / "one.h5", options, Error::Kind::usage), Catch::Contains("there is right"));
  options.stream = "right";
  const Reading reading = read_hdf5(folder / "both.h5", options);
  CHECK(reading.events == expected_events(right));
  CHECK(reading.header.sensor == SensorSize{1280, 720});
  CHECK(reading.header.layout == "M3ED, right");

  const Reading one = read_hdf5(folder / "one.h5");
  CHECK(one.events == expected_events(right));
  CHECK_FALSE(one.header.sensor);
  REQUIRE(one.header.notes.size() == 1);
  CHECK_THAT(one.header.notes[0], Catch::Contains("resolution is no sensor size"));
}

TEST_CASE("the option --stream is refused where an HDF5 file has one stream") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", Columns(3));
  }
  ReadOptions options;
  options.stream = "left";
  CHECK_THAT(hdf5_error(folder / "a.h5", options, Error::Kind::usage),
             Catch::Contains("only one event stream"));
}

TEST_CASE("ms_to_idx is compared with the times and never used") {
  struct Case {
    std::vector<std::int64_t> index;
    bool fits;
  };
  // 9000 events, three every 2 us: 1500 events a millisecond.
  const std::vector<Case> cases = {
      {{0, 1500, 3000, 4500, 6000, 7500}, true},
      {{0, 1500, 3000, 4500, 6000, 7500, 9000}, true},
      {{0, 0, 0, 0, 0, 0}, false},
      {{0, 1501, 3001, 4501, 6001, 7501}, false},
      {{7500, 6000, 4500, 3000, 1500, 0}, false},
      {{0, 1500, 3000, 4500, 6000, 9001}, false},
      {{0, 1500, 3000, -4500, 6000, 7500}, false},
      {{}, true},
  };
  const TempFolder folder;
  const Columns columns(9000);
  for (const Case& test : cases) {
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/events/", columns);
      file.column("/ms_to_idx", test.index);
      file.scalar("/t_offset", 0);
    }
    const Reading reading = read_hdf5(folder / "a.h5");
    CHECK(reading.events == expected_events(columns));
    CHECK(reading.header.notes.empty() == test.fits);
    if (!test.fits)
      CHECK_THAT(reading.header.notes.at(0), Catch::Contains("ms_to_idx contradicts the times"));
  }
}

TEST_CASE("An HDF5 recording without events ends at once") {
  const TempFolder folder;
  for (const hsize_t chunk : {0, 100}) {
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/events/", Columns(0), {.chunk = chunk});
    }
    const Reading reading = read_hdf5(folder / "a.h5");
    CHECK(reading.events.empty());
    CHECK_FALSE(reading.losses.any());
  }
}

TEST_CASE("An HDF5 signature may stand behind a user block") {
  const std::string signature = "\x89HDF\r\n\x1a\n";
  const auto looks = [](const std::string& head) { return looks_like_hdf5(std::as_bytes(std::span(head))); };
  CHECK(looks(signature));
  for (const std::size_t offset : {512U, 1024U, 2048U}) {
    CHECK(looks(std::string(offset, '\0') + signature));
    CHECK_FALSE(looks(std::string(offset + 1, '\0') + signature));
  }
  CHECK_FALSE(looks(signature.substr(0, 7)));
  CHECK_FALSE(looks(""));
}

TEST_CASE("Several threads may read HDF5 files at the same time") {
  const TempFolder folder;
  const Columns columns(150000);
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns, {.chunk = 5000, .filters = gzip});
  }
  std::vector<Reading> readings(4);
  std::vector<std::thread> threads;
  threads.reserve(readings.size());
  for (Reading& reading : readings) {
    threads.emplace_back([&reading, &folder] { reading = read_hdf5(folder / "a.h5"); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Reading& reading : readings) CHECK(reading.events == expected_events(columns));
}

}  // namespace

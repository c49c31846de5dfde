// Layouts with times in seconds, and numbers that no event can have.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "support/hdf5_layouts.hpp"
#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

constexpr std::int64_t kSince1970_us = 1744227144732712;

TEST_CASE("HDF5 seconds since 1970 become the nearest microsecond, halves upwards") {
  struct Case {
    double seconds;
    std::int64_t t_us;
  };
  // 1/128 s are 7812.5 us, exactly. Of seconds since 1970, the last bit is 2^-22 s; 6 of them are 1.43 us,
  // which microseconds since 1970 cannot tell from 1.5.
  const std::vector<Case> cases = {{1.0 / 128, 7813},
                                   {-1.0 / 128, -7812},
                                   {-1 - 3.0 / 128, -1023437},
                                   {-0.75, -750000},
                                   {0.00000051, 1},
                                   {0.00000049, 0},
                                   {1744227144.732712, kSince1970_us},
                                   {1744227144.732713, kSince1970_us + 1},
                                   {1744227144.999999, 1744227144999999},
                                   {1744227144 + std::ldexp(6, -22), 1744227144000001}};
  const TempFolder folder;
  std::vector<MvsecRow> rows;
  std::vector<std::int64_t> expected;
  for (const Case& test : cases) {
    rows.push_back({1, 2, test.seconds, 1});
    expected.push_back(test.t_us);
  }
  {
    Hdf5Writer file(folder / "a.h5");
    write_mvsec(file, "/davis/left/events", rows, 4);
  }
  std::vector<std::int64_t> times;
  for (const Event& event : read_hdf5(folder / "a.h5").events) times.push_back(event.t_us);
  CHECK(times == expected);
}

TEST_CASE("MVSEC coordinates that are no pixel are counted, odd polarities said") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<MvsecRow> rows = {{1, 2, 0, 1},      {1.5, 2, 0, 1},   {1, -1, 0, 1},
                                      {nan, 2, 0, 1},    {1, 65536, 0, 1}, {1e300, 2, 0, 1},
                                      {65535, 0, 0, -1}, {1, 2, 1e-6, 0},  {1, 2, 1e-6, 0.5},
                                      {1, 2, 1e-6, nan}, {1, 2, 1e-6, 7}};
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    write_mvsec(file, "/davis/left/events", rows, 4);
  }
  const Reading reading = read_hdf5(folder / "a.h5");
  CHECK(reading.events == std::vector<Event>{{0, 1, 2, true},
                                             {0, 65535, 0, false},
                                             {1, 1, 2, false},
                                             {1, 1, 2, true},
                                             {1, 1, 2, false},
                                             {1, 1, 2, true}});
  CHECK(reading.losses.of(Drop::outside_sensor) == 5);
  REQUIRE(reading.header.notes.size() == 1);
  CHECK_THAT(reading.header.notes[0], Contains("/davis/left/events, row 10: polarity 7"));
}

TEST_CASE("HDF5 times in seconds that 64 bits cannot hold are an error that names the row") {
  const TempFolder folder;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e13, -1e300}) {
    INFO(bad);
    std::vector<MvsecRow> rows(9001, {1, 2, 0, 1});
    rows[9000][2] = bad;
    std::vector<double> times(9001, 0);
    times[9000] = bad;
    {
      Hdf5Writer file(folder / "mvsec.h5");
      write_mvsec(file, "/davis/left/events", rows, 1000);
      Hdf5Writer monash(folder / "monash.h5");
      write_monash(monash, std::vector<Event>(9001));
      monash.remove("/events/ts");
      monash.dataset("/events/ts", {9001}, {.type = H5T_IEEE_F64LE}, H5T_NATIVE_DOUBLE, times.data());
    }
    CHECK_THAT(hdf5_error(folder / "mvsec.h5"),
               Contains("/davis/left/events, row 9000") && Contains("64 bits"));
    CHECK_THAT(hdf5_error(folder / "monash.h5"), Contains("/events/ts, row 9000") && Contains("64 bits"));
  }
}

}  // namespace

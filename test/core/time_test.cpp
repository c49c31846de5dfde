#include "esi/core/time.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

#include "esi/core/error.hpp"
#include "esi/core/event.hpp"

using namespace esi;
using Catch::Matchers::Contains;

TEST_CASE("an interval is half-open") {
  const Interval interval{10, 20};
  CHECK_FALSE(interval.contains(9));
  CHECK(interval.contains(10));
  CHECK(interval.contains(19));
  CHECK_FALSE(interval.contains(20));
  CHECK(Interval{5, 5}.is_empty());
}

TEST_CASE("seconds become microseconds, rounded half up") {
  CHECK(us_from_seconds(0.0000004) == 0);
  CHECK(us_from_seconds(0.0000005) == 1);
  CHECK(us_from_seconds(-0.25) == -250000);
  CHECK(us_from_seconds(1744227144.25) == 1744227144250000);
  CHECK_THROWS_AS(us_from_seconds(1e300), Error);
  CHECK_THROWS_AS(us_from_seconds(std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST_CASE("times are written with nine decimals, exactly") {
  CHECK(seconds_text(0) == "0.000000000");
  CHECK(seconds_text(10000) == "0.010000000");
  CHECK(seconds_text(-1) == "-0.000001000");
  CHECK(seconds_text(1744227144732712) == "1744227144.732712000");
  CHECK(seconds_text(INT64_MIN) == "-9223372036854.775808000");
}

TEST_CASE("a sensor size is read from WxH and nothing else") {
  CHECK(parse_sensor_size("346x260") == SensorSize{346, 260});
  CHECK(parse_sensor_size("65536x1") == SensorSize{65536, 1});
  const auto bad = GENERATE("", "346", "346x", "x260", "346X260", "346x260 ", " 346x260", "0x5", "-3x5",
                            "65537x2", "1e2x5", "99999999999x1");
  CAPTURE(bad);
  CHECK_THROWS_WITH(parse_sensor_size(bad), Contains("sensor size"));
}

#include "esi/io/text/clock.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace esi::test {
namespace {

constexpr std::int64_t k31 = std::int64_t{1} << 31;
constexpr std::int64_t k32 = std::int64_t{1} << 32;

std::vector<std::int64_t> accepted(TextClock& clock, const std::vector<std::int64_t>& raw) {
  std::vector<std::int64_t> times;
  for (const std::int64_t t_us : raw) times.push_back(clock.accept(t_us));
  return times;
}

}  // namespace

TEST_CASE("A counter that wraps goes on, also for events that jitter over the wrap") {
  struct Row {
    const char* what;
    std::vector<std::int64_t> raw, expected;
    int bits;
  };
  const Row row = GENERATE(values<Row>({
      {"31 bits", {k31 - 2, 1, 5}, {k31 - 2, k31 + 1, k31 + 5}, 31},
      {"32 bits", {k32 - 2, 1, 5}, {k32 - 2, k32 + 1, k32 + 5}, 32},
      {"32 bits with sign", {k31 - 2, -k31 + 1, 0}, {k31 - 2, k31 + 1, k32}, 32},
      {"twice", {k31 - 1, 0, k31 / 2, k31 - 1, 3}, {k31 - 1, k31, k31 * 3 / 2, 2 * k31 - 1, 2 * k31 + 3}, 31},
      {"jitter over it", {k32 - 5, 2, k32 - 1, 3}, {k32 - 5, k32 + 2, k32 - 1, k32 + 3}, 32},
      {"a gap behind it", {k31 - 2, 1, k31 - 100000000}, {k31 - 2, k31 + 1, 2 * k31 - 100000000}, 31},
      {"a gap of minutes", {k31 - k31 / 10, k31 / 10}, {k31 - k31 / 10, k31 + k31 / 10}, 31},
      {"no wrap: from the middle", {k32 / 2 + 9, 1}, {k32 / 2 + 9, 1}, 0},
      {"no wrap: from below the top", {k31 * 3 / 4, 1}, {k31 * 3 / 4, 1}, 0},
      {"no wrap: a short fall", {k32 - 2, k32 / 2 + 1}, {k32 - 2, k32 / 2 + 1}, 0},
      {"no wrap: beyond 32 bits", {k32 + 1, 1}, {k32 + 1, 1}, 0},
      {"no wrap: jitter", {100, 90, 110}, {100, 90, 110}, 0},
      {"no wrap: a leap forward", {1, k32 - 1}, {1, k32 - 1}, 0},
  }));
  INFO(row.what);
  TextClock clock(true);
  CHECK(accepted(clock, row.raw) == row.expected);
  CHECK(clock.wrapped_bits() == row.bits);
  CHECK(clock.latest_us() == row.expected.back());
}

TEST_CASE("Times that are no counter don't wrap") {
  TextClock clock(false);
  CHECK(accepted(clock, {k32 - 2, 1}) == std::vector<std::int64_t>{k32 - 2, 1});
}

TEST_CASE("A clock knows how long the recording lasts, from its earliest to its latest time") {
  TextClock clock(true);
  CHECK_FALSE(clock.has_started());
  CHECK(clock.duration_us() == 0);
  accepted(clock, {-50, -70, 30, 20});
  CHECK(clock.duration_us() == 100);
  clock.follow(45);
  CHECK(clock.duration_us() == 115);
}

}  // namespace esi::test

#include <fmt/format.h>

#include "bad_input/bad_input.hpp"
#include "support/sample_text.hpp"
#include "support/zip_file.hpp"

namespace esi::test {
namespace {

/// 3000 good events, 10 us apart, with something between or around them.
std::function<std::string()> text(const std::string& before, const std::string& between = "",
                                  const std::string& after = "") {
  return [=] {
    const std::string lines = sample_text(3000, 10);
    const std::size_t middle = lines.find('\n', lines.size() / 2) + 1;
    return before + lines.substr(0, middle) + between + lines.substr(middle) + after;
  };
}

std::function<std::string()> raw(std::string bytes) {
  return [bytes = std::move(bytes)] { return bytes; };
}

/// Lines "t x y p" for t = first, first + step, ...
std::function<std::string()> lines(std::int64_t first, std::int64_t step, int count) {
  return [=] {
    std::string all;
    for (int i = 0; i < count; ++i)
      all += fmt::format("{} {} {} {}\n", first + i * step, i % 12, i % 9, i % 2);
    return all;
  };
}

/// 2 s in microseconds, written with a decimal point as seconds are.
std::string microseconds_with_point() {
  std::string all;
  for (int i = 0; i < 20000; ++i) all += fmt::format("{}.0 {} {} {}\n", i * 100, i % 12, i % 9, i % 2);
  return all;
}

std::string utf16(const std::string& ascii) {
  std::string wide = "\xff\xfe";
  for (const char c : ascii) wide += {c, '\0'};
  return wide;
}

std::string replaced(std::string text, char from, const std::string& to) {
  std::string result;
  for (const char c : text) result += c == from ? to : std::string(1, c);
  return result;
}

const std::vector<std::string> kNoSize = {};
const std::vector<std::string> kSmall = {"--size", "12x9"};

}  // namespace

BadInputs bad_text() {
  return {
      "Text and csv",
      "events.txt",
      {
          {"empty file", 1, "empty", raw(""), kSmall},
          {"only comments", 1, "no events", raw("# nothing\n# here\n"), kSmall},
          {"only a header", 1, "no events", raw("t,x,y,p\n"), kSmall},
          {"no sensor size anywhere", 2, "--size", text(""), kNoSize},
          {"`#` comments among the lines", 0, "", text("# a\n", "# b\n", "# c\n"), kSmall},
          {"first line `W H`", 0, "", text("12 9\n"), kNoSize},
          {"`%geometry:W,H`", 0, "", raw("%geometry:12,9\n1,2,1,0\n1,2,0,500\n3,3,1,5000\n"), kNoSize},
          {"absurd size in the header", 1, "sensor size", text("99999999 9\n"), kNoSize},
          {"Windows line ends", 0, "", [] { return replaced(sample_text(3000, 10), '\n', "\r\n"); }, kSmall},
          {"UTF-8 byte order mark", 0, "", text("\xEF\xBB\xBF"), kSmall},
          {"UTF-16", 1, "UTF-16", [] { return utf16(sample_text(300, 10)); }, kSmall},
          {"binary", 1, "binary", raw(std::string("\0\1\2\3\4\5\6\7", 8)), kSmall},
          {"gzip called .txt", 1, "gzip", raw("\x1f\x8b\x08 and so on"), kSmall},
          {"last line cut", 3, "cut_line", text("", "", "0.0300 1"), kSmall},
          {"line with a column too many", 1, "cannot be read, the first at line",
           text("", std::string("0.02 1 1 1 1\n") + "0.02 1 1 1 1\n0.02 1 1 1 1\n0.02 1 1 1 1\n"), kSmall},
          {"first line with a column too few", 1, "has 3 columns", raw("0.1 1 1\n0.2 1 1\n"), kSmall},
          {"mixed separators in one line", 3, "unreadable_line", text("", "0.015 1,1 1\n"), kSmall},
          {"nan, inf, hexadecimal in a line each", 3, "3 unreadable_line",
           text("", "nan 1 1 1\ninf 1 1 1\n0x1p3 1 1 1\n"), kSmall},
          {"more than 0.1 % of the lines unreadable", 1, "--max-unreadable",
           text("", "nan 1 1 1\nnan 1 1 1\nnan 1 1 1\nnan 1 1 1\n"), kSmall},
          {"decimal comma", 1, "decimal points", [] { return replaced(sample_text(300, 10), '.', ","); },
           kSmall},
          {"negative coordinates", 3, "2 outside_sensor", text("", "0.015 -1 2 1\n0.015 1 -2 1\n"), kSmall},
          {"coordinates outside the sensor", 3, "1 outside_sensor", text("", "0.015 12 2 1\n"), kSmall},
          {"more than 1 % of the events outside",
           1,
           "largest x is 11, the largest y 8",
           text(""),
           {"--size", "11x9"}},
          {"number that overflows", 3, "1 unreadable_line", text("", "99999999999999999999999999.5 1 1 1\n"),
           kSmall},
          {"polarity -1/1", 0, "", raw("0.001 1 1 -1\n0.002 1 1 1\n0.003 1 1 -1\n"), kSmall},
          {"polarity 1/2", 0, "", raw("0.001 1 1 2\n0.002 1 1 1\n0.003 1 1 2\n"), kSmall},
          {"polarity of no kind", 1, "--columns", raw("0.001 1 1 7\n0.002 1 1 9\n0.003 1 1 8\n"), kSmall},
          {"microseconds read as seconds", 1, "--time-unit, perhaps us", microseconds_with_point, kSmall},
          {"seconds written as whole numbers", 1, "--time-unit", lines(0, 1, 60), kSmall},
          {"columns in another order", 1, "--columns", raw("1 2 0.001 1\n1 3 0.002 0\n4 2 0.003 1\n"),
           kSmall},
          {"time goes back by jitter", 3, "1 sorted_jitter", text("", "0.0145 1 1 1\n"), kSmall},
          {"time goes back by more, up to a second", 3, "1 backward_time", text("", "0.001 1 1 1\n"), kSmall},
          {"time goes back by seconds", 1, "--max-backward-us",
           raw("5.0 1 1 1\n5.1 1 1 1\n5.2 1 1 1\n1.0 1 1 1\n1.1 1 1 1\n"), kSmall},
          {"one event far in the future", 3, "1 time_jump", text("", "5000.0 1 1 1\n"), kSmall},
          {"every event twice", 0, "", raw("0.001 1 1 1\n0.001 1 1 1\n0.003 1 1 0\n0.003 1 1 0\n"), kSmall},
          {"clock of 32 bits wraps", 0, "", lines(4294967296 - 2000000, 1000, 2000), kSmall},
          {"a gap of hours", 1, "--max-frames", raw("0.0 1 1 1\n0.01 1 1 0\n80000.0 1 1 1\n80000.1 1 1 0\n"),
           kSmall},
          {"line of a million characters", 3, "1 unreadable_line",
           [] { return sample_text(3000, 10) + std::string(1000000, '7') + "\n"; }, kSmall},
          {"a single event", 0, "", raw("0.5 1 1 1\n"), kSmall},
          {"all events at one time", 0, "", raw("0.5 1 1 1\n0.5 2 1 1\n0.5 3 1 0\n"), kSmall},
          {"epoch seconds", 0, "", raw("1700000000.000001 1 1 1\n1700000000.5 2 1 0\n"), kSmall},
          {"loss with --strict", 1, "--strict", text("", "nan 1 1 1\n"), {"--size", "12x9", "--strict"}},
          {"zip with two files", 1, "holds 2 files",
           [] {
             return zip_archive({{"a.txt", "1"}, {"b.txt", "1"}});
           },
           kSmall},
          {"zip that is cut", 1, "cannot be opened",
           [] {
             return zip_archive({{"a.txt", sample_text(300, 10)}}).substr(0, 500);
           },
           kSmall},
          {"zip whose text has the wrong checksum", 3, "1 cut_packet",
           [] {
             return zip_archive({{"a.txt", sample_text(3000, 10), true, false, 1}});
           },
           kSmall},
      }};
}

}  // namespace esi::test

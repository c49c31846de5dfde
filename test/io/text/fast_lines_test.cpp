// The fast path must read exactly what the careful one reads, and nothing else.
#include "esi/io/text/fast_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "io/text/read_text.hpp"

namespace esi::test {
namespace {

struct Form {
  std::vector<TextColumn> columns;
  bool is_seconds;
  char separator;
  bool has_carriage_returns;
  PolarityCode polarity;

  TextDialect dialect() const {
    TextDialect dialect;
    dialect.separator = separator;
    dialect.columns = columns;
    dialect.has_carriage_returns = has_carriage_returns;
    dialect.time_shift = is_seconds ? 6 : 0;
    dialect.has_time_points = is_seconds;
    dialect.polarity = polarity;
    return dialect;
  }
};

std::vector<Form> forms() {
  using enum TextColumn;
  std::vector<Form> all;
  for (const auto& columns : {std::vector{t, x, y, p}, std::vector{x, y, p, t}}) {
    for (const bool is_seconds : {false, true}) {
      for (const char separator : {' ', '\t', ','}) {
        for (const bool has_carriage_returns : {false, true}) {
          for (const auto code :
               {PolarityCode::zero_one, PolarityCode::one_two, PolarityCode::minus_plus_one}) {
            all.push_back({columns, is_seconds, separator, has_carriage_returns, code});
          }
        }
      }
    }
  }
  return all;
}

class Writer {
 public:
  Writer(const Form& form, unsigned seed) : form_(form), random_(seed) {}

  std::string lines(int count) {
    std::string text;
    std::int64_t t_us = pick(0, 9) == 0 ? 0 : pick(0, 1) == 0 ? pick(0, 20000000) : 1744227144000000;
    for (int i = 0; i < count; ++i) {
      t_us += pick(0, 20) == 0 ? pick(0, 3000000) : pick(0, 30);
      text += line(t_us);
    }
    return text;
  }

  std::string line(std::int64_t t_us) {
    const std::int64_t off = form_.polarity == PolarityCode::one_two          ? 1
                             : form_.polarity == PolarityCode::minus_plus_one ? -1
                                                                              : 0;
    const std::int64_t on = form_.polarity == PolarityCode::one_two ? 2 : 1;
    const std::int64_t p = pick(0, 1) == 0 ? off : on;
    const std::string x = std::to_string(coordinate()), y = std::to_string(coordinate());
    const bool is_time_first = form_.columns.front() == TextColumn::t;
    const std::string end = form_.has_carriage_returns ? "\r\n" : "\n";
    const char s = form_.separator;
    if (is_time_first) return fmt::format("{}{}{}{}{}{}{}{}", time(t_us), s, x, s, y, s, p, end);
    return fmt::format("{}{}{}{}{}{}{}{}", x, s, y, s, p, s, time(t_us), end);
  }

  std::int64_t pick(std::int64_t min, std::int64_t max) {
    return std::uniform_int_distribution<std::int64_t>(min, max)(random_);
  }

 private:
  std::int64_t coordinate() {
    return pick(0, 30) == 0 ? pick(0, 65535) : pick(0, pick(0, 1) == 0 ? 9 : 1279);
  }

  // Mostly six decimals; else fewer, or more that must be rounded.
  std::string time(std::int64_t t_us) {
    if (!form_.is_seconds) return std::to_string(t_us);
    std::string text = fmt::format("{}.{:06}", t_us / 1000000, t_us % 1000000);
    if (pick(0, 5) == 0) text += std::to_string(pick(0, 99999999999));
    while (pick(0, 9) == 0 && text[text.size() - 2] != '.') text.pop_back();
    return text;
  }

  const Form& form_;
  std::mt19937 random_;
};

// What parse_line makes of every line.
std::vector<Event> read_carefully(std::string_view text, TextDialect dialect) {
  std::vector<Event> events;
  TextClock clock(dialect.time_shift == 0);
  while (!text.empty()) {
    const std::size_t size = std::min(text.find('\n'), text.size() - 1) + 1;
    TextLine line = parse_line(text.substr(0, size), dialect);
    text.remove_prefix(size);
    if (line.kind != TextLine::Kind::event) continue;
    line.event.t_us = clock.accept(line.event.t_us);
    events.push_back(line.event);
  }
  return events;
}

// What read_fast makes of the lines that it takes, parse_line of the others.
std::vector<Event> read_both_ways(std::string text, TextDialect dialect, std::size_t& fast_events) {
  const std::size_t size = text.size();
  text = std::string(64, '7') + text + std::string(64, '7');  // the margins, of the most misleading kind
  std::string_view lines(text.data() + 64, size);
  std::vector<Event> events;
  std::vector<Event> target(100);
  TextClock clock(dialect.time_shift == 0);
  while (!lines.empty()) {
    if (clock.has_started()) {
      const FastLines taken = read_fast(*fast_layout(dialect), lines, clock, target);
      events.insert(events.end(), target.begin(), target.begin() + static_cast<std::ptrdiff_t>(taken.events));
      lines.remove_prefix(taken.bytes);
      fast_events += taken.events;
    }
    const std::string_view line = lines.substr(0, lines.find('\n') + 1);
    lines.remove_prefix(line.size());
    TextLine read = parse_line(line, dialect);
    if (read.kind != TextLine::Kind::event) continue;
    read.event.t_us = clock.accept(read.event.t_us);
    events.push_back(read.event);
  }
  return events;
}

// Changes, drops, doubles or swaps some characters, but leaves a '\n' at the end.
std::string damaged(std::string text, Writer& random) {
  static constexpr std::string_view kCharacters = "0123456789.,-+ \t\r\n#%eExna\x01\x80\xff";
  for (int i = 0; i < 40; ++i) {
    const auto at = static_cast<std::size_t>(random.pick(0, static_cast<std::int64_t>(text.size()) - 2));
    const char c = kCharacters[static_cast<std::size_t>(random.pick(0, 26))];
    switch (random.pick(0, 3)) {
      case 0:
        text[at] = c;
        break;
      case 1:
        text.erase(at, 1);
        break;
      case 2:
        text.insert(at, 1, c);
        break;
      default:
        std::swap(text[at], text[at + 1]);
    }
    if (text.back() != '\n') text += '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("The fast path reads plain lines as the careful path does") {
  unsigned seed = 1;
  for (const Form& form : forms()) {
    Writer writer(form, ++seed);
    std::size_t fast_events = 0;
    for (int i = 0; i < 20; ++i) {
      const std::string text = writer.lines(300);
      INFO(text.substr(0, 400));
      REQUIRE(read_both_ways(text, form.dialect(), fast_events) == read_carefully(text, form.dialect()));
    }
    CHECK(fast_events > 20 * 300 * 8 / 10);
  }
}

TEST_CASE("The fast path takes no line that the careful path would not, whatever is damaged") {
  unsigned seed = 1000;
  for (const Form& form : forms()) {
    Writer writer(form, ++seed);
    std::size_t fast_events = 0;
    for (int i = 0; i < 100; ++i) {
      const std::string text = damaged(writer.lines(60), writer);
      INFO(text);
      REQUIRE(read_both_ways(text, form.dialect(), fast_events) == read_carefully(text, form.dialect()));
    }
    CHECK(fast_events > 1000);
  }
}

TEST_CASE("The fast path leaves forms it does not know to the careful path") {
  using enum TextColumn;
  TextDialect dialect = forms().front().dialect();
  CHECK(fast_layout(dialect));
  dialect.time_shift = 3;
  CHECK_FALSE(fast_layout(dialect));
  dialect = forms().front().dialect();
  dialect.columns = {t, y, x, p};
  CHECK_FALSE(fast_layout(dialect));
  dialect.columns = {t, x, y, p, other};
  CHECK_FALSE(fast_layout(dialect));
}

}  // namespace esi::test

#include "esi/io/text/fast_lines.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "esi/io/text/time_shape.hpp"

namespace esi {
namespace {

// How a separator, p and what follows it look in a word of characters. (word - bias) & mask must be
// `expected`, and bit 8 of the difference says whether it is ON: all without branches on p, which nobody
// could predict.
struct PolarityForm {
  std::uint32_t bias, mask, expected;
  std::size_t size;  // characters, without a sign

  PolarityForm(const FastLayout& layout, std::string_view behind_p) : size(2 + behind_p.size()) {
    const bool is_one_two = layout.polarity == PolarityCode::one_two;
    const bool has_two_digits = is_one_two || layout.polarity == PolarityCode::zero_one;
    const char plain[4] = {layout.separator, has_two_digits ? '0' : '1', behind_p.front(), behind_p.back()};
    bias = is_one_two ? 1 << 8 : 0;
    mask = (behind_p.size() == 2 ? 0xffff00ff : 0x00ff00ff) | (has_two_digits ? 0xfe00 : 0xff00);
    expected = load_characters<std::uint32_t>(plain) & mask;
  }
};

// x, y and p, such as "190 82 1": the part of a line that is different every time. `has_sign`: -1 is OFF.
template <bool has_sign>
class PixelPart {
 public:
  PixelPart(const char* at, const PolarityForm& form) : at_(at) {
    // Where there are less than two non-digits, these count as such, behind all that is plain.
    constexpr std::uint32_t kGuard = 3U << 16;
    const std::uint32_t stops = non_digits(at) | kGuard;
    stop_x_ = static_cast<unsigned>(__builtin_ctz(stops));
    stop_y_ = static_cast<unsigned>(__builtin_ctz(stops & (stops - 1)));
    auto ending = load_characters<std::uint64_t>(at + stop_y_);
    if (has_sign && (ending >> 8 & 0xff) == '-') {
      sign_ = 1;
      ending = (ending & 0xff) | (ending >> 8 & ~std::uint64_t{0xff});
    }
    ending_ = static_cast<std::uint32_t>(ending) - form.bias;
  }

  /// Whether it is x and y of 1 to 4 digits and p of one, with separators between and the right end.
  bool is_plain(const PolarityForm& form, char separator) const {
    const unsigned digits = (stop_x_ - 1) | (stop_y_ - stop_x_ - 2);
    return digits < 4 && at_[stop_x_] == separator && (ending_ & form.mask) == form.expected;
  }

  bool is_on() const { return (ending_ >> 8 & 1 & ~sign_) != 0; }

  /// Four digits of x and four of y. Shifting aligns them and puts zeros before them.
  std::uint64_t digits() const {
    const std::uint32_t x = load_characters<std::uint32_t>(at_) << (32 - 8 * stop_x_);
    const std::uint64_t y = load_characters<std::uint64_t>(at_ + stop_x_ + 1)
                            << (64 - 8 * (stop_y_ - stop_x_ - 1));
    return (x | y) & 0x0f0f0f0f0f0f0f0f;
  }

  /// Behind what follows p.
  const char* end(const PolarityForm& form) const { return at_ + stop_y_ + form.size + sign_; }

 private:
  const char* at_;
  unsigned stop_x_, stop_y_;
  unsigned sign_ = 0;  // characters before p
  std::uint32_t ending_;
};

template <bool is_time_last, bool is_seconds, bool has_sign>
FastLines read_lines(const FastLayout& layout, std::string_view lines, TextClock& clock,
                     std::span<Event> target) {
  const std::string_view line_end = layout.has_carriage_returns ? "\r\n" : "\n";
  const std::string_view separator(&layout.separator, 1);
  const std::string_view behind_time = is_time_last ? line_end : separator;
  const std::string_view behind_p = is_time_last ? separator : line_end;
  const PolarityForm form(layout, behind_p);

  const char* line = lines.data();
  const char* const end = line + lines.size();
  TimeShape<is_seconds> shape;
  const std::int64_t offset_us = clock.offset_us();
  std::int64_t previous_us = clock.previous_us();
  std::size_t n = 0;
  while (line < end && n < target.size()) {
    const char* time = line;
    if (!is_time_last && !shape.matches(time) && !shape.learn(time, behind_time)) break;
    const PixelPart<has_sign> pixel(is_time_last ? line : time + shape.size(), form);
    if (!pixel.is_plain(form, layout.separator)) break;
    const char* next = pixel.end(form);
    if (is_time_last) {
      time = next;
      if (!shape.matches(time) && !shape.learn(time, behind_time)) break;
      next = time + shape.size();
    }
    const auto tail = shape.tail(time);
    const auto [x_y, t] = join_digits(pixel.digits(), tail.digits);
    const std::int64_t raw_us = shape.value_us(t, tail.rounds_up);
    const auto step_us = static_cast<std::uint64_t>(raw_us - previous_us);
    if (step_us > static_cast<std::uint64_t>(TextClock::kMaxPlainStep_us)) break;
    target[n++] = {raw_us + offset_us, static_cast<std::uint16_t>(x_y), static_cast<std::uint16_t>(x_y >> 32),
                   pixel.is_on()};
    previous_us = raw_us;
    line = next;
  }
  if (n > 0) clock.follow(previous_us);
  return {n, static_cast<std::size_t>(line - lines.data())};
}

}  // namespace

std::optional<FastLayout> fast_layout(const TextDialect& dialect) {
  using enum TextColumn;
  static constexpr std::array kTxyp = {t, x, y, p};
  static constexpr std::array kXypt = {x, y, p, t};
  FastLayout layout;
  layout.is_time_last =
      std::equal(dialect.columns.begin(), dialect.columns.end(), kXypt.begin(), kXypt.end());
  const bool is_time_first =
      std::equal(dialect.columns.begin(), dialect.columns.end(), kTxyp.begin(), kTxyp.end());
  if (!layout.is_time_last && !is_time_first) return std::nullopt;
  if (dialect.time_shift != 0 && dialect.time_shift != 6) return std::nullopt;
  layout.is_seconds = dialect.time_shift == 6;
  layout.separator = dialect.separator;
  layout.has_carriage_returns = dialect.has_carriage_returns;
  layout.polarity = dialect.polarity;
  return layout;
}

FastLines read_fast(const FastLayout& layout, std::string_view lines, TextClock& clock,
                    std::span<Event> target) {
  const auto read = [&](auto... choice) {
    return read_lines<decltype(choice)::value...>(layout, lines, clock, target);
  };
  const auto with_sign = [&](auto... choice) {
    const bool has_sign = layout.polarity == PolarityCode::minus_plus_one;
    return has_sign ? read(choice..., std::true_type{}) : read(choice..., std::false_type{});
  };
  if (layout.is_time_last) {
    return layout.is_seconds ? with_sign(std::true_type{}, std::true_type{})
                             : with_sign(std::true_type{}, std::false_type{});
  }
  return layout.is_seconds ? with_sign(std::false_type{}, std::true_type{})
                           : with_sign(std::false_type{}, std::false_type{});
}

}  // namespace esi

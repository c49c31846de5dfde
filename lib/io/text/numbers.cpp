#include "esi/io/text/numbers.hpp"

#include <algorithm>
#include <charconv>

namespace esi {
namespace {

constexpr int kMaxExponent = 9999;  // any larger one gives 0 or overflow

std::string_view take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  const std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  return digits;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

std::optional<int> take_exponent(std::string_view& text) {
  const bool negative = take(text, '-');
  if (!negative) take(text, '+');
  const std::string_view digits = take_digits(text);
  if (digits.empty()) return std::nullopt;
  int exponent = 0;
  for (const char c : digits) exponent = std::min(exponent * 10 + (c - '0'), kMaxExponent);
  return negative ? -exponent : exponent;
}

// The digits of a number by their place: 0 is the first one written, zeros follow the last.
class Digits {
 public:
  explicit Digits(const Decimal& number) : number_(number) {}

  std::int64_t size() const {
    return static_cast<std::int64_t>(number_.whole.size() + number_.fraction.size());
  }
  int at(std::int64_t place) const {
    if (place < 0 || place >= size()) return 0;
    const auto i = static_cast<std::size_t>(place);
    const std::size_t n = number_.whole.size();
    return (i < n ? number_.whole[i] : number_.fraction[i - n]) - '0';
  }
  bool any_from(std::int64_t place) const {
    for (std::int64_t i = std::max<std::int64_t>(place, 0); i < size(); ++i) {
      if (at(i) != 0) return true;
    }
    return false;
  }

 private:
  const Decimal& number_;
};

}  // namespace

std::optional<Decimal> split_decimal(std::string_view text) {
  Decimal number;
  number.negative = take(text, '-');
  if (!number.negative) take(text, '+');
  number.whole = take_digits(text);
  number.has_point = take(text, '.');
  if (number.has_point) number.fraction = take_digits(text);
  if (number.whole.empty() && number.fraction.empty()) return std::nullopt;
  if (take(text, 'e') || take(text, 'E')) {
    const auto exponent = take_exponent(text);
    if (!exponent) return std::nullopt;
    number.exponent = *exponent;
    number.has_point = true;
  }
  if (!text.empty()) return std::nullopt;
  return number;
}

std::optional<ScaledNumber> scaled(const Decimal& number, int shift) {
  const Digits digits(number);
  const std::int64_t point = static_cast<std::int64_t>(number.whole.size()) + number.exponent + shift;
  std::int64_t magnitude = 0;
  for (std::int64_t i = 0; i < point; ++i) {
    if (i >= digits.size() && magnitude == 0) break;  // 0e9999
    magnitude = magnitude * 10 + digits.at(i);
    if (magnitude > kMaxNumber / 10) {
      if (i + 1 < point || magnitude > kMaxNumber) return std::nullopt;
    }
  }
  const int next = digits.at(point);
  const bool more = digits.any_from(point + 1);
  // Half up means towards +infinity: -0.5 becomes 0.
  const bool away = number.negative ? next > 5 || (next == 5 && more) : next >= 5;
  if (away) ++magnitude;
  return ScaledNumber{number.negative ? -magnitude : magnitude, next == 0 && !more};
}

std::optional<std::int64_t> parse_whole(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop == end && error == std::errc{}) {
    if (value > kMaxNumber || value < -kMaxNumber) return std::nullopt;
    return value;
  }
  const auto number = split_decimal(text);
  if (!number) return std::nullopt;
  const auto result = scaled(*number, 0);
  if (!result || !result->is_exact) return std::nullopt;
  return result->value;
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace esi {

/// Times beyond this (146 thousand years in us) count as overflow, so that the difference of any two fits.
inline constexpr std::int64_t kMaxNumber = std::int64_t{1} << 62;

/// A decimal number taken apart, such as "-1.5e3".
struct Decimal {
  std::string_view whole, fraction;  ///< digits before and behind the point; not both empty
  int exponent = 0;
  bool negative = false;
  bool has_point = false;  ///< a point or an exponent: not written as a whole number
};

/// Nothing for what is not a finite decimal number: nan, inf, hexadecimal, a decimal comma, an empty text.
std::optional<Decimal> split_decimal(std::string_view text);

struct ScaledNumber {
  std::int64_t value = 0;
  bool is_exact = true;  ///< nothing was rounded away
};

/// number * 10^shift, rounded half up to a whole number, in exact arithmetic however many digits there are.
/// Nothing where it lies beyond +-kMaxNumber.
std::optional<ScaledNumber> scaled(const Decimal& number, int shift);

/// A whole number, also when written "219.0" or "2.19e+02" as numpy.savetxt does.
std::optional<std::int64_t> parse_whole(std::string_view text);

}  // namespace esi

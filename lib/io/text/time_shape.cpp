#include "esi/io/text/time_shape.hpp"

#include <algorithm>

namespace esi {
namespace {

constexpr int kMaxCharacters = 30;
constexpr int kTailDigits = 8;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

int count_digits(const char* at, int max) {
  return static_cast<int>(std::find_if_not(at, at + max, is_digit) - at);
}

std::int64_t number(const char* at, int digits) {
  std::int64_t value = 0;
  for (int i = 0; i < digits; ++i) value = value * 10 + (at[i] - '0');
  return value;
}

}  // namespace

template <bool is_seconds>
bool TimeShape<is_seconds>::learn(const char* time, std::string_view terminator) {
  constexpr int kMaxWhole = is_seconds ? 12 : 16;  // so that nothing overflows
  const int whole = count_digits(time, kMaxWhole + 1);
  if (whole == 0 || whole > kMaxWhole) return false;
  int head = std::max(whole - kTailDigits, 0);
  int end = whole;
  if (is_seconds) {
    head = whole + 1;
    end = head + count_digits(time + head, kMaxCharacters - head + 1);
    if (time[whole] != '.' || end == head || end > kMaxCharacters) return false;
  }
  if (std::string_view(time + end, terminator.size()) != terminator) return false;

  size_ = static_cast<unsigned>(end) + static_cast<unsigned>(terminator.size());
  std::fill(std::begin(low_), std::end(low_), static_cast<unsigned char>(0x00));
  std::fill(std::begin(high_), std::end(high_), static_cast<unsigned char>(0xff));
  std::copy_n(time, size_, low_);
  std::copy_n(time, size_, high_);
  std::fill(low_ + head, low_ + end, static_cast<unsigned char>('0'));
  std::fill(high_ + head, high_ + end, static_cast<unsigned char>('9'));
  const int tail = std::min(end - head, kTailDigits);
  const std::uint64_t unused = 64 - 8 * static_cast<std::uint64_t>(tail);
  constexpr std::uint64_t kValues = 0x0f0f0f0f0f0f0f0f;
  if (is_seconds) {
    head_us_ = number(time, whole) * 1000000;
    tail_offset_ = head;
    tail_mask_ = kValues & ~std::uint64_t{0} >> unused;
  } else {
    head_us_ = number(time, head) * 100000000;
    tail_offset_ = end - kTailDigits;
    tail_mask_ = kValues & ~std::uint64_t{0} << unused;
  }
  return true;
}

template class TimeShape<true>;
template class TimeShape<false>;

}  // namespace esi

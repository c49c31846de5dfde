#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace esi {

/// Characters that are taken several at a time into one word, the first of them in its lowest byte.
template <class Word>
Word load_characters(const char* at) {
  static_assert(std::endian::native == std::endian::little);
  Word word;
  std::memcpy(&word, at, sizeof(word));
  return word;
}

/// Two numbers of four digits each: the first in the lower half.
using FourDigitPair = std::uint64_t;

/// Joins twice eight digits (values, not characters) to pairs of numbers.
inline std::pair<FourDigitPair, FourDigitPair> join_digits(std::uint64_t a, std::uint64_t b) {
#ifdef __SSE2__
  const __m128i digits = _mm_set_epi64x(static_cast<std::int64_t>(b), static_cast<std::int64_t>(a));
  const __m128i tens = _mm_mullo_epi16(_mm_and_si128(digits, _mm_set1_epi16(0xff)), _mm_set1_epi16(10));
  const __m128i pairs = _mm_add_epi16(tens, _mm_srli_epi16(digits, 8));
  const __m128i fours = _mm_madd_epi16(pairs, _mm_set1_epi32(1 << 16 | 100));
  return {static_cast<FourDigitPair>(_mm_cvtsi128_si64(fours)),
          static_cast<FourDigitPair>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(fours, fours)))};
#else
  const auto join = [](std::uint64_t digits) {
    const std::uint64_t pairs = (digits * (10 << 8 | 1)) >> 8 & 0x00ff00ff00ff00ff;
    return (pairs * (100 << 16 | 1)) >> 16 & 0x0000ffff0000ffff;
  };
  return {join(a), join(b)};
#endif
}

/// Bit i: whether at[i] is no digit, for 16 characters.
inline std::uint32_t non_digits(const char* at) {
#ifdef __SSE2__
  const __m128i characters = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
  const __m128i values = _mm_sub_epi8(characters, _mm_set1_epi8('0'));
  const __m128i beyond_9 = _mm_cmpeq_epi8(_mm_max_epu8(values, _mm_set1_epi8(10)), values);
  return static_cast<std::uint32_t>(_mm_movemask_epi8(beyond_9));
#else
  std::uint32_t bits = 0;
  for (int i = 0; i < 16; ++i) bits |= std::uint32_t{static_cast<unsigned char>(at[i] - '0') > 9} << i;
  return bits;
#endif
}

/// Whether 16 characters are each within its bounds.
inline bool are_between(const unsigned char* low, const char* at, const unsigned char* high) {
#ifdef __SSE2__
  const auto load = [](const void* from) { return _mm_loadu_si128(static_cast<const __m128i*>(from)); };
  const __m128i characters = load(at);
  const __m128i clamped = _mm_min_epu8(_mm_max_epu8(characters, load(low)), load(high));
  return _mm_movemask_epi8(_mm_cmpeq_epi8(clamped, characters)) == 0xffff;
#else
  bool result = true;
  for (int i = 0; i < 16; ++i) {
    const auto c = static_cast<unsigned char>(at[i]);
    result = result && low[i] <= c && c <= high[i];
  }
  return result;
#endif
}

/// How a time is written, learnt from one line: "13.58" and six more digits, then a blank. Times that follow
/// share all of it but the last digits (of "seconds", those behind the point; of whole us, the last eight),
/// so that only those need reading.
template <bool is_seconds>
class TimeShape {
 public:
  /// Learns from a time that ends before `terminator` (of one or two characters). False where it is not
  /// plain: more than 30 characters, a sign, no digit on either side of the point.
  bool learn(const char* time, std::string_view terminator);

  /// Whether the time at `time` is written so. Nothing is before something was learnt.
  bool matches(const char* time) const {
    if (!are_between(low_, time, high_)) return false;
    if (size_ > 0 && size_ <= 16) return true;
    return size_ > 16 && are_between(low_ + 16, time + 16, high_ + 16);
  }

  /// The last eight digits of the time at `time`, which matches, in the form that join_digits takes; of
  /// seconds, six of them.
  struct Tail {
    std::uint64_t digits;
    bool rounds_up;
  };
  Tail tail(const char* time) const {
    const std::uint64_t digits = load_characters<std::uint64_t>(time + tail_offset_) & tail_mask_;
    if (!is_seconds) return {digits, false};
    return {digits << 16, (digits >> 48 & 0xff) >= 5};
  }

  /// The time whose tail that is, its digits joined.
  std::int64_t value_us(FourDigitPair joined, bool rounds_up) const {
    const std::uint64_t tail = (joined & 0xffff) * 10000 + (joined >> 32);
    return head_us_ + static_cast<std::int64_t>(tail) + (rounds_up ? 1 : 0);
  }

  /// Characters of the time and its terminator.
  unsigned size() const { return size_; }

 private:
  unsigned char low_[32] = {}, high_[32] = {};  ///< which characters may stand where
  unsigned size_ = 0;
  std::int64_t head_us_ = 0;
  std::ptrdiff_t tail_offset_ = 0;
  std::uint64_t tail_mask_ = 0;  ///< to the values of the last digits
};

}  // namespace esi

#pragma once

#include <cstdint>

namespace esi {

/// A counter of kBits bits that starts again from 0: a fall by more than half its range is a wrap, a smaller
/// one is time that goes back.
template <int kBits>
class WrappingTime {
 public:
  std::int64_t unwrap(std::int64_t value) {
    if (last_ - value > kRange / 2) base_ += kRange;
    last_ = value;
    return base_ + value;
  }

 private:
  static constexpr std::int64_t kRange = std::int64_t{1} << kBits;

  std::int64_t base_ = 0;
  std::int64_t last_ = 0;
};

}  // namespace esi

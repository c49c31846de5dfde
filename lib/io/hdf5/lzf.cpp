#include "esi/io/hdf5/lzf.hpp"

#include <algorithm>

namespace esi {
namespace {

/// LZF is a sequence of runs. A byte below 32 announces that many literals plus one. Any other holds in its
/// upper three bits the length of a repetition less 2 (7: the next byte is added), and in its lower five,
/// with the byte that follows, how far back it begins, less 1.
struct Run {
  std::size_t header_bytes = 1;
  std::size_t length = 0;
  std::size_t back = 0;  ///< 0 for literals, which follow the header

  std::size_t stored_bytes() const { return header_bytes + (back == 0 ? length : 0); }
};

/// Nothing where `stored` ends within the run.
std::optional<Run> first_run(std::span<const std::byte> stored) {
  const auto byte_at = [&](std::size_t i) { return std::to_integer<std::size_t>(stored[i]); };
  const std::size_t control = byte_at(0);
  Run run;
  if (control < 32) {
    run.length = control + 1;
  } else {
    const bool is_long = control >> 5 == 7;
    run.header_bytes = is_long ? 3 : 2;
    if (stored.size() < run.header_bytes) return std::nullopt;
    run.length = (control >> 5) + (is_long ? byte_at(1) : 0) + 2;
    run.back = (control & 31) * 256 + byte_at(run.header_bytes - 1) + 1;
  }
  if (stored.size() < run.stored_bytes()) return std::nullopt;
  return run;
}

}  // namespace

std::optional<std::size_t> decode_lzf(std::span<const std::byte> stored, std::span<std::byte> target) {
  std::size_t done = 0;
  while (!stored.empty()) {
    const auto run = first_run(stored);
    if (!run || run->length > target.size() - done || run->back > done) return std::nullopt;
    std::byte* const out = target.data() + done;
    if (run->back == 0) {
      std::copy_n(stored.data() + run->header_bytes, run->length, out);
    } else {
      // Forwards, byte by byte: a repetition may overlap itself.
      const std::byte* const from = out - run->back;
      for (std::size_t i = 0; i < run->length; ++i) out[i] = from[i];
    }
    done += run->length;
    stored = stored.subspan(run->stored_bytes());
  }
  return done;
}

}  // namespace esi

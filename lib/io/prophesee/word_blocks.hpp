#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// Decodes the whole little-endian words of `bytes` and appends their events; bytes that are left over at the
/// end are not looked at. `decode_word(word, next)` writes at most kMostEvents events to `next` and returns
/// where the next one goes.
template <class Word, std::size_t kMostEvents, class DecodeWord>
void append_decoded(std::span<const std::byte> bytes, std::vector<Event>& events, DecodeWord decode_word) {
  constexpr std::size_t kBlockWords = 2048 / kMostEvents;
  // Left uninitialised: the vector then grows by whole blocks of events that are there.
  std::array<Event, kBlockWords * kMostEvents> block;
  while (bytes.size() >= sizeof(Word)) {
    const std::size_t words = std::min(kBlockWords, bytes.size() / sizeof(Word));
    Event* next = block.data();
    for (std::size_t i = 0; i < words; ++i) {
      Word word;
      std::memcpy(&word, bytes.data() + i * sizeof word, sizeof word);
      next = decode_word(word, next);
    }
    events.insert(events.end(), block.data(), next);
    bytes = bytes.subspan(words * sizeof(Word));
  }
}

/// How many bytes a reader gives to a decoder at once, so that packets stay small: at most 12288 events.
inline constexpr std::size_t kDecodedAtOnceBytes = 2048;

}  // namespace esi

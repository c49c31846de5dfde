#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "esi/io/prophesee/evt21_decoder.hpp"
#include "esi/io/prophesee/evt2_decoder.hpp"
#include "esi/io/prophesee/evt3_decoder.hpp"

namespace esi {

/// The decoder of one of Prophesee's encodings, chosen at run time.
class EvtDecoder {
 public:
  /// By the encoding's name, "EVT2", "EVT21" or "EVT3"; empty for others. `order` is for EVT21 only.
  static std::optional<EvtDecoder> of(std::string_view encoding,
                                      Evt21Decoder::HalfOrder order = Evt21Decoder::HalfOrder::low_first);

  std::size_t word_bytes() const;
  /// Appends the events of whole words.
  void decode(std::span<const std::byte> words, std::vector<Event>& events);
  /// Events before the first time word: they have no time and are left out.
  std::int64_t events_without_time() const;

 private:
  using AnyDecoder = std::variant<Evt2Decoder, Evt21Decoder, Evt3Decoder>;

  explicit EvtDecoder(AnyDecoder decoder) : decoder_(decoder) {}

  AnyDecoder decoder_;
};

}  // namespace esi

#include "esi/io/prophesee/evt_decoder.hpp"

namespace esi {

std::optional<EvtDecoder> EvtDecoder::of(std::string_view encoding, Evt21Decoder::HalfOrder order) {
  if (encoding == "EVT2") return EvtDecoder(Evt2Decoder());
  if (encoding == "EVT21") return EvtDecoder(Evt21Decoder(order));
  if (encoding == "EVT3") return EvtDecoder(Evt3Decoder());
  return std::nullopt;
}

std::size_t EvtDecoder::word_bytes() const {
  return std::visit([](const auto& decoder) { return decoder.kWordBytes; }, decoder_);
}

void EvtDecoder::decode(std::span<const std::byte> words, std::vector<Event>& events) {
  std::visit([&](auto& decoder) { decoder.decode(words, events); }, decoder_);
}

std::int64_t EvtDecoder::events_without_time() const {
  return std::visit([](const auto& decoder) { return decoder.events_without_time(); }, decoder_);
}

}  // namespace esi

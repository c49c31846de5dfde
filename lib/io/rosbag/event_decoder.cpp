#include "esi/io/rosbag/event_decoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {
namespace {

constexpr std::size_t kMessageBytes = 64;

/// Fit for a message of one line.
std::string printable(std::string_view text) {
  std::string result(text.substr(0, kMessageBytes));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

template <class Decoder>
std::size_t word_bytes_of(const Decoder& decoder) {
  if constexpr (std::is_same_v<Decoder, EvtDecoder>) {
    return decoder.word_bytes();
  } else {
    return decoder.kWordBytes;
  }
}

}  // namespace

// EVT words are one stream over all messages; the other encodings begin anew in each.
std::optional<RosEventDecoder::AnyDecoder> RosEventDecoder::decoder_for(const RosEvents& message) const {
  const std::string_view encoding = message.encoding;
  if (encoding == kDvsEncoding) return DvsDecoder();
  if (encoding == "libcaer") return LibcaerDecoder(message.time_base_ns);
  if (encoding == "libcaer_cmp") return LibcaerCmpDecoder(message.time_base_ns);
  if (encoding == "mono") return MonoDecoder(message.time_base_ns);
  if (encoding == encoding_ && std::holds_alternative<EvtDecoder>(decoder_)) return decoder_;
  if (encoding == "evt3") return EvtDecoder::of("EVT3");
  if (encoding == "evt2") return EvtDecoder::of("EVT2");
  if (encoding == "evt21") return EvtDecoder::of("EVT21");
  return std::nullopt;
}

std::string RosEventDecoder::begin(const RosEvents& message) {
  const auto decoder = decoder_for(message);
  if (!decoder) {
    return fmt::format(
        "its events are encoded as '{}', but evt2, evt21, evt3, libcaer, libcaer_cmp and mono are known",
        printable(message.encoding));
  }
  if (message.is_bigendian) return "its events are big-endian, which can't be read";
  const std::size_t word_bytes = std::visit([](const auto& known) { return word_bytes_of(known); }, *decoder);
  if (message.data.size() % word_bytes != 0) {
    return fmt::format("its events have {} bytes, which is no multiple of {}", message.data.size(),
                       word_bytes);
  }
  decoder_ = *decoder;
  encoding_ = message.encoding;
  word_bytes_ = word_bytes;
  rest_ = message.data;
  return {};
}

void RosEventDecoder::decode_some(std::vector<Event>& events) {
  const std::size_t whole_words = kDecodedAtOnceBytes / word_bytes_ * word_bytes_;
  const auto words = rest_.first(std::min(whole_words, rest_.size()));
  rest_ = rest_.subspan(words.size());
  std::visit([&](auto& decoder) { decoder.decode(words, events); }, decoder_);
}

std::int64_t RosEventDecoder::events_without_time() const {
  const auto* const evt = std::get_if<EvtDecoder>(&decoder_);
  return evt == nullptr ? 0 : evt->events_without_time();
}

}  // namespace esi

#include "esi/io/prophesee/dat_decoder.hpp"

#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {

void DatDecoder::decode(std::span<const std::byte> records, std::vector<Event>& events) {
  WrappingTime<32> time_us = time_us_;  // in registers
  append_decoded<std::uint64_t, 1>(records, events, [&time_us](std::uint64_t record, Event* next) {
    const auto x = static_cast<std::uint16_t>(record >> 32 & 0x3FFF);
    const auto y = static_cast<std::uint16_t>(record >> 46 & 0x3FFF);
    *next++ = {time_us.unwrap(static_cast<std::uint32_t>(record)), x, y, (record >> 60 & 1) != 0};
    return next;
  });
  time_us_ = time_us;
}

}  // namespace esi

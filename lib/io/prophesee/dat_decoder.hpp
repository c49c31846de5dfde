#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/prophesee/wrapping_time.hpp"

namespace esi {

/// The records of a Prophesee DAT file, 8 bytes each: uint32 time in us, uint32 with x, y and polarity. See
/// formats.md section 7. Wraps of the time are counted from call to call.
class DatDecoder {
 public:
  static constexpr std::size_t kRecordBytes = 8;

  /// Appends the events of whole records.
  void decode(std::span<const std::byte> records, std::vector<Event>& events);

 private:
  WrappingTime<32> time_us_;
};

}  // namespace esi

#include "esi/io/aedat2/address.hpp"

namespace esi {

bool are_dvs128_records(std::span<const std::byte> records) {
  for (; records.size() >= kAedat2RecordBytes; records = records.subspan(kAedat2RecordBytes)) {
    if (!Dvs128Address{aedat2_word(records.data())}.fits()) return false;
  }
  return true;
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "esi/io/aedat4/streams.hpp"
#include "esi/io/byte_window.hpp"
#include "esi/io/decompress.hpp"

namespace esi {

inline constexpr std::string_view kAedat4Magic = "#!AER-DAT4.0\r\n";

/// What stands before an AEDAT 4 file's packets.
struct Aedat4Header {
  Codec codec = Codec::none;
  std::string compression;  ///< as the format calls it, such as "LZ4_HIGH"
  /// Where the packets end. -1: never written, the recorder was killed.
  std::int64_t data_table_position = -1;
  std::vector<Aedat4Stream> streams;

  /// nullptr when there is no stream of that id.
  const Aedat4Stream* find(int id) const;
  /// "0: EVTS 346x260, 2: IMUS"
  std::string streams_text() const;
};

/// Takes the magic bytes and the header. Throws an Error when they are cut, damaged or name no streams.
Aedat4Header read_aedat4_header(ByteWindow& bytes);

}  // namespace esi

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// One of the streams that share a file. Ids have gaps; a stream may have no packets at all.
struct Aedat4Stream {
  int id = 0;
  std::string type;                ///< "EVTS", "FRME", "IMUS", "TRIG"; empty where the file does not say
  std::string source;              ///< the camera, such as "DAVIS346_00000104"; may be empty
  std::optional<SensorSize> size;  ///< events and frames only; empty where it is missing or impossible

  /// "0: EVTS 346x260 DAVIS346_00000104"
  std::string text() const;
};

/// The streams that the header's XML declares. Throws an Error ("NAME: ...") when it is malformed.
std::vector<Aedat4Stream> parse_aedat4_streams(std::string_view xml, const std::string& name);

}  // namespace esi

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/byte_window.hpp"
#include "esi/io/prophesee/evt_decoder.hpp"

namespace esi {

/// What stands before a RAW file's words.
struct PropheseeRawHeader {
  EvtDecoder decoder;
  std::string encoding;  ///< "EVT2", "EVT21", "EVT3"
  std::optional<SensorSize> sensor;
  std::vector<std::string> notes;
};

/// Takes the header. Throws an Error where it names no encoding, or one that is not known.
PropheseeRawHeader read_raw_header(ByteWindow& bytes);

}  // namespace esi

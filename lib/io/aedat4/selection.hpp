#pragma once

#include <optional>
#include <string>

#include "esi/io/aedat4/header.hpp"

namespace esi {

/// What is read of a file's streams.
struct Aedat4Selection {
  Aedat4Stream events;
  std::optional<Aedat4Stream> frames;  ///< images of the same camera
};

/// The event stream with the number `wanted`, or the only one where `wanted` is empty, and the first stream
/// of frames by its camera. `name` is what messages call the file. Throws an Error that lists the streams
/// when there is no event stream, a usage Error when there are several or not the wanted one.
Aedat4Selection select_aedat4_streams(const Aedat4Header& header, const std::string& wanted,
                                      const std::string& name);

}  // namespace esi

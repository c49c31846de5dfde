#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/byte_window.hpp"
#include "esi/io/read_options.hpp"

namespace esi {

inline constexpr std::string_view kAedat3Magic = "#!AER-DAT3.";

/// One of the cameras or processing modules whose packets share a file.
struct Aedat3Source {
  int id = 0;
  std::string name;                ///< "DAVIS240C", or "File,dvsSizeX=240,dvsSizeY=180,..."
  std::optional<SensorSize> size;  ///< of the polarity events; empty where it is not known or there are none
  bool has_frames = false;

  /// "1: DAVIS240C 240x180"
  std::string text() const;
};

/// What stands before an AEDAT 3.1 file's packets.
struct Aedat3Header {
  std::vector<Aedat3Source> sources;

  /// nullptr when there is no source of that id.
  const Aedat3Source* find(int id) const;
};

/// Takes the header. Throws an Error when it is cut, damaged, of another version or of a compressed format.
Aedat3Header read_aedat3_header(ByteWindow& bytes);

/// The source that --stream names, or else the only one that can have polarity events. Empty where the header
/// declares no source: then those of all packets are taken. `name` is what messages call the file. Throws a
/// usage Error that lists the sources when there are several or not the wanted one.
std::optional<Aedat3Source> select_aedat3_source(const Aedat3Header& header, const ReadOptions& options,
                                                 const std::string& name);

}  // namespace esi

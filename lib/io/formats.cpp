#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/io/aedat4/reader.hpp"
#include "esi/io/format_reader.hpp"
#include "esi/io/hdf5/reader.hpp"
#include "esi/io/text/kind.hpp"
#include "esi/io/text/reader.hpp"

namespace esi {
namespace {

// A new format is one file and one row. Text comes last: it has no magic bytes.
constexpr Format kFormats[] = {
    {"aedat4", ".aedat4", "DV and dv-processing, AEDAT 4.0: events and intensity frames", looks_like_aedat4,
     open_aedat4},
    {"hdf5", ".h5 .hdf5", "HDF5 with columns x, y, p, t: DSEC, TUM-VIE, EDS, e2calib, M3ED", looks_like_hdf5,
     open_hdf5},
    {"text", ".txt .csv", "text and csv: RPG events.txt, rpg_e2vid, t,x,y,p and Metavision x,y,p,t",
     looks_like_text, open_text},
};

std::string known_formats() {
  std::string names;
  for (const Format& format : kFormats) {
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", format.name, format.extensions);
  }
  return names;
}

}  // namespace

std::span<const Format> formats() { return kFormats; }

std::unique_ptr<FormatReader> open_reader(const std::filesystem::path& path, const ReadOptions& options) {
  auto bytes = std::make_unique<ByteSource>(path);
  const auto head = bytes->peek(kFormatHeadBytes);
  if (head.empty()) throw Error(fmt::format("{}: the file is empty", bytes->name()));
  const auto format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const Format& f) { return f.recognises(head); });
  if (format == std::end(kFormats)) {
    throw Error(
        fmt::format("{}: {}; known formats are {}", bytes->name(), describe_non_text(head), known_formats()));
  }
  return format->open(std::move(bytes), options);
}

}  // namespace esi

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/io/aedat2/reader.hpp"
#include "esi/io/aedat3/reader.hpp"
#include "esi/io/aedat4/reader.hpp"
#include "esi/io/format_reader.hpp"
#include "esi/io/hdf5/reader.hpp"
#include "esi/io/prophesee/dat_reader.hpp"
#include "esi/io/prophesee/raw_reader.hpp"
#include "esi/io/rosbag/reader.hpp"
#include "esi/io/text/kind.hpp"
#include "esi/io/text/reader.hpp"
#include "esi/io/zip.hpp"

namespace esi {
namespace {

// A new format is one file and one row. Text comes last: it has no magic bytes.
constexpr Format kFormats[] = {
    {"aedat4", ".aedat4", "DV and dv-processing, AEDAT 4.0: events and intensity frames", looks_like_aedat4,
     open_aedat4},
    {"aedat2", ".aedat", "jAER, AEDAT 2.0: events and intensity frames of DVS128 and DAVIS",
     looks_like_aedat2, open_aedat2},
    {"aedat3", ".aedat", "cAER, AEDAT 3.1: events and intensity frames", looks_like_aedat3, open_aedat3},
    {"hdf5", ".h5 .hdf5", "HDF5: DSEC, TUM-VIE, EDS, e2calib, M3ED, MVSEC, Monash (event_utils), Metavision",
     looks_like_hdf5, open_hdf5},
    {"prophesee-raw", ".raw", "Prophesee RAW with EVT2, EVT2.1 or EVT3", looks_like_prophesee_raw,
     open_prophesee_raw},
    {"prophesee-dat", ".dat", "Prophesee DAT", looks_like_prophesee_dat, open_prophesee_dat},
    {"rosbag", ".bag", "ROS 1 bags: events of dvs_msgs and event_camera_msgs, and the camera's images",
     looks_like_rosbag, open_rosbag},
    {"text", ".txt .csv .zip",
     "text and csv, also in a zip: RPG events.txt, rpg_e2vid, t,x,y,p and Metavision x,y,p,t",
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
  if (looks_like_zip(bytes->peek(kFormatHeadBytes))) bytes = open_zip_entry(*bytes);
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

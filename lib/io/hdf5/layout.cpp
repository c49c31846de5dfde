#include "esi/io/hdf5/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/columns.hpp"
#include "esi/io/hdf5/time_index.hpp"

namespace esi {
namespace {

bool has_columns(const Hdf5File& file, const std::string& group) {
  return file.has_dataset(group + "x") && file.has_dataset(group + "y") && file.has_dataset(group + "t") &&
         file.has_dataset(group + "p");
}

/// The integers of a small dataset. Throws an Error where it holds more than `limit`, or something else.
std::vector<std::int64_t> read_integers(const Hdf5File& file, const std::string& path, std::uint64_t limit) {
  Hdf5Column column(file, path);
  const std::uint64_t count = column.dataset().rows();
  if (count == 0 || count > limit)
    throw Error(fmt::format("{} has {} values", column.dataset().where(), count));
  if (const auto reason = column.load(0, count)) throw Error(column.dataset().where() + ": " + *reason);
  std::vector<std::int64_t> values(count);
  column.copy(0, values);
  return values;
}

void refuse_stream(const Hdf5File& file, const ReadOptions& options) {
  if (options.stream.empty()) return;
  throw usage_error(fmt::format("{}: has only one event stream, not '{}'; leave --stream out", file.name(),
                                options.stream));
}

/// t_offset of DSEC: one integer, in microseconds.
std::int64_t read_offset_us(const Hdf5File& file, const std::string& path) {
  if (!file.has_dataset(path)) return 0;
  return read_integers(file, path, 1).front();
}

bool is_dsec(const Hdf5File& file) { return has_columns(file, "/events/"); }

std::unique_ptr<Hdf5EventTable> open_dsec(const Hdf5File& file, const ReadOptions& options,
                                          RecordingHeader& header) {
  refuse_stream(file, options);
  auto table =
      std::make_unique<Hdf5Columns>(file, "/events/", read_offset_us(file, "/t_offset"), header.notes);
  if (file.has_dataset("/ms_to_idx")) {
    const std::string note = check_time_index(file, "/ms_to_idx", "/events/t");
    if (!note.empty()) header.notes.push_back(note);
  }
  return table;
}

bool is_root(const Hdf5File& file) { return has_columns(file, "/"); }

std::unique_ptr<Hdf5EventTable> open_root(const Hdf5File& file, const ReadOptions& options,
                                          RecordingHeader& header) {
  refuse_stream(file, options);
  return std::make_unique<Hdf5Columns>(file, "/", 0, header.notes);
}

constexpr std::array<std::string_view, 2> kM3edStreams = {"left", "right"};

std::string m3ed_group(std::string_view stream) { return fmt::format("/prophesee/{}/", stream); }

bool is_m3ed(const Hdf5File& file) {
  return std::any_of(kM3edStreams.begin(), kM3edStreams.end(),
                     [&](std::string_view stream) { return has_columns(file, m3ed_group(stream)); });
}

std::string choose_m3ed_stream(const Hdf5File& file, const ReadOptions& options) {
  std::vector<std::string> present;
  for (const std::string_view stream : kM3edStreams) {
    if (has_columns(file, m3ed_group(stream))) present.emplace_back(stream);
  }
  if (options.stream.empty() && present.size() == 1) return present.front();
  if (std::find(present.begin(), present.end(), options.stream) != present.end()) return options.stream;
  throw usage_error(fmt::format("{}: say with --stream which event stream is meant; there is {}", file.name(),
                                fmt::join(present, " and ")));
}

/// calib/resolution: width, height.
void read_m3ed_sensor(const Hdf5File& file, const std::string& path, RecordingHeader& header) {
  if (!file.has_dataset(path)) return;
  const std::vector<std::int64_t> size = read_integers(file, path, 2);
  const auto is_side = [](std::int64_t side) { return side > 0 && side <= kMaxSensorSide_px; };
  if (size.size() == 2 && is_side(size[0]) && is_side(size[1])) {
    header.sensor = SensorSize{static_cast<int>(size[0]), static_cast<int>(size[1])};
  } else {
    header.notes.push_back(
        fmt::format("{} is no sensor size ({}); it is not used", path, fmt::join(size, " x ")));
  }
}

std::unique_ptr<Hdf5EventTable> open_m3ed(const Hdf5File& file, const ReadOptions& options,
                                          RecordingHeader& header) {
  const std::string stream = choose_m3ed_stream(file, options);
  header.layout += ", " + stream;
  read_m3ed_sensor(file, m3ed_group(stream) + "calib/resolution", header);
  return std::make_unique<Hdf5Columns>(file, m3ed_group(stream), 0, header.notes);
}

/// How many of a file's datasets a message names.
constexpr std::size_t kMostListed = 20;

constexpr std::array kLayouts = {
    Hdf5Layout{"DSEC, TUM-VIE", "/events/{x,y,t,p}", is_dsec, open_dsec},
    Hdf5Layout{"M3ED", "/prophesee/{left,right}/{x,y,t,p}", is_m3ed, open_m3ed},
    Hdf5Layout{"EDS, e2calib", "/{x,y,t,p}", is_root, open_root},
};

[[noreturn]] void refuse_unknown(const Hdf5File& file) {
  std::vector<std::string> known;
  known.reserve(kLayouts.size());
  for (const Hdf5Layout& layout : kLayouts)
    known.push_back(fmt::format("{} ({})", layout.datasets, layout.name));
  std::vector<std::string> found = file.dataset_paths(kMostListed + 1);
  if (found.empty()) found.emplace_back("none");
  if (found.size() > kMostListed) found.back() = "...";
  throw Error(fmt::format("{}: no known layout of events; datasets found: {}; known layouts: {}", file.name(),
                          fmt::join(found, ", "), fmt::join(known, ", ")));
}

}  // namespace

std::span<const Hdf5Layout> hdf5_layouts() { return kLayouts; }

const Hdf5Layout& find_hdf5_layout(const Hdf5File& file) {
  for (const Hdf5Layout& layout : kLayouts) {
    if (layout.recognises(file)) return layout;
  }
  refuse_unknown(file);
}

}  // namespace esi

// Layouts of four columns with times in microseconds.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/layout_tools.hpp"
#include "esi/io/hdf5/time_index.hpp"

namespace esi {
namespace {

/// `group` ends in "/".
Hdf5ColumnPaths columns_of(const std::string& group) {
  return {group + "x", group + "y", group + "t", group + "p"};
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

/// t_offset of DSEC: one integer, in microseconds.
std::int64_t read_offset_us(const Hdf5File& file, const std::string& path) {
  if (!file.has_dataset(path)) return 0;
  return read_integers(file, path, 1).front();
}

bool is_dsec(const Hdf5File& file) { return has_columns(file, columns_of("/events/")); }

Hdf5Content open_dsec(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header) {
  refuse_stream(file, options);
  auto table = std::make_unique<Hdf5Columns>(file, columns_of("/events/"), read_offset_us(file, "/t_offset"),
                                             header.notes);
  if (file.has_dataset("/ms_to_idx")) {
    const std::string note = check_time_index(file, "/ms_to_idx", "/events/t");
    if (!note.empty()) header.notes.push_back(note);
  }
  return {std::move(table), nullptr};
}

bool is_root(const Hdf5File& file) { return has_columns(file, columns_of("/")); }

Hdf5Content open_root(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header) {
  refuse_stream(file, options);
  return {std::make_unique<Hdf5Columns>(file, columns_of("/"), 0, header.notes), nullptr};
}

std::string m3ed_group(const std::string& stream) { return fmt::format("/prophesee/{}/", stream); }

std::vector<std::string> m3ed_streams(const Hdf5File& file) {
  std::vector<std::string> present;
  for (const char* const stream : {"left", "right"}) {
    if (has_columns(file, columns_of(m3ed_group(stream)))) present.emplace_back(stream);
  }
  return present;
}

bool is_m3ed(const Hdf5File& file) { return !m3ed_streams(file).empty(); }

/// calib/resolution: width, height.
void read_m3ed_sensor(const Hdf5File& file, const std::string& path, RecordingHeader& header) {
  if (!file.has_dataset(path)) return;
  const std::vector<std::int64_t> size = read_integers(file, path, 2);
  const double height_px = size.size() == 2 ? static_cast<double>(size[1]) : 0;
  use_sensor_size(static_cast<double>(size[0]), height_px, path, header);
}

Hdf5Content open_m3ed(const Hdf5File& file, const ReadOptions& options, RecordingHeader& header) {
  const std::string stream = choose_stream(file, options, m3ed_streams(file));
  header.layout += ", " + stream;
  read_m3ed_sensor(file, m3ed_group(stream) + "calib/resolution", header);
  return {std::make_unique<Hdf5Columns>(file, columns_of(m3ed_group(stream)), 0, header.notes), nullptr};
}

}  // namespace

constinit const Hdf5Layout kDsecLayout = {"DSEC, TUM-VIE", "/events/{x,y,t,p}", is_dsec, open_dsec};
constinit const Hdf5Layout kM3edLayout = {"M3ED", "/prophesee/{left,right}/{x,y,t,p}", is_m3ed, open_m3ed};
constinit const Hdf5Layout kRootLayout = {"EDS, e2calib", "/{x,y,t,p}", is_root, open_root};

}  // namespace esi

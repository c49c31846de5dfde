#include "bad_input/bad_input.hpp"
#include "support/hdf5_file.hpp"
#include "support/hdf5_layouts.hpp"
#include "support/recordings.hpp"

namespace esi::test {
namespace {

using Write = std::function<void(Hdf5Writer&)>;

std::function<std::string()> file_of(const Write& write) {
  return [write] {
    const TempFolder folder;
    {
      Hdf5Writer file(folder / "recording.h5");
      write(file);
    }
    return content_of(folder / "recording.h5");
  };
}

/// 3000 events in DSEC's layout, in chunks of 1000, changed by `change`.
std::function<std::string()> dsec(const Write& change,
                                  const Storage& storage = {.chunk = 1000, .filters = gzip}) {
  return file_of([=](Hdf5Writer& file) {
    Columns columns(3000);
    for (auto& x : columns.x) x %= 240;
    for (auto& y : columns.y) y %= 180;
    for (auto& t : columns.t) t *= 10;
    write_columns(file, "/events/", columns, storage);
    change(file);
  });
}

Write replaced(const char* path, const std::vector<hsize_t>& extent, hid_t type) {
  return [=](Hdf5Writer& file) {
    file.remove(path);
    file.dataset(path, extent, {.type = type});
  };
}

Write with_chunk(const std::string& stored) {
  return [=](Hdf5Writer& file) { file.replace_chunk("/events/t", 1000, stored.data(), stored.size()); };
}

void nothing(Hdf5Writer& /*file*/) {}

Write with_external_link() {
  return [](Hdf5Writer& file) {
    file.remove("/events/t");
    H5Lcreate_external("/etc/passwd", "/t", file.id(), "/events/t", H5P_DEFAULT, H5P_DEFAULT);
  };
}

}  // namespace

BadInputs bad_hdf5() {
  return {
      "HDF5",
      "recording.h5",
      {
          {"truncated", 1, "is truncated",
           [] {
             const std::string bytes = dsec(nothing)();
             return bytes.substr(0, bytes.size() / 2);
           }},
          {"only the signature", 1, "HDF5", [] { return std::string("\x89HDF\r\n\x1a\n"); }},
          {"no known layout", 1, "datasets found: /imu", file_of([](Hdf5Writer& file) {
             file.column("/imu", {1, 2});
           })},
          {"no events", 1, "no events",
           file_of([](Hdf5Writer& file) { write_columns(file, "/events/", Columns(0)); })},
          {"columns of unequal length", 1, "has 99 rows", dsec(replaced("/events/y", {99}, H5T_STD_U16LE))},
          {"float times", 1, "floating-point", dsec(replaced("/events/t", {3000}, H5T_IEEE_F64LE))},
          {"two dimensions", 1, "2 dimensions", dsec(replaced("/events/x", {3000, 1}, H5T_STD_U16LE))},
          {"big-endian integers", 0, "", dsec(nothing, {.type = H5T_STD_I64BE, .chunk = 1000})},
          {"filter that is not there", 1, "filter", dsec(nothing, {.chunk = 1000, .filters = filter(32015)})},
          {"corrupt chunk", 3, "1 corrupt_packet", dsec(with_chunk("this is not gzip"))},
          {"2^60 declared events", 3, "1 cut_packet",
           dsec(nothing, {.chunk = 1000, .declared = hsize_t{1} << 60, .filters = gzip})},
          {"link into another file", 1, "/etc/passwd", dsec(with_external_link())},
          {"ms_to_idx that contradicts the times", 0, "", dsec([](Hdf5Writer& file) {
             file.column("/ms_to_idx", {5, 4, 3, 2});
           })},
          {"no sensor size", 2, "--size", dsec(nothing), {}},
          {"MVSEC: not a number among the times", 1, "row", file_of([](Hdf5Writer& file) {
             auto rows = mvsec_rows(moving_edge(300));
             rows[7][2] = std::numeric_limits<double>::quiet_NaN();
             write_mvsec(file, "/davis/left/events", rows, 100);
           })},
          {"MVSEC: a coordinate that is no whole number", 3, "1 outside_sensor",
           file_of([](Hdf5Writer& file) {
             auto rows = mvsec_rows(moving_edge(300));
             rows[7][0] = 3.5;
             write_mvsec(file, "/davis/left/events", rows, 100);
           })},
          {"MVSEC: left and right", 2, "--stream", file_of([](Hdf5Writer& file) {
             write_mvsec(file, "/davis/left/events", mvsec_rows(moving_edge(300)), 100);
             write_mvsec(file, "/davis/right/events", mvsec_rows(moving_edge(300)), 100);
           })},
          {"Metavision: events compressed with ECF", 1, "36559", file_of([](Hdf5Writer& file) {
             const hid_t type = H5Tcreate(H5T_COMPOUND, 16);
             H5Tinsert(type, "x", 0, H5T_STD_U16LE);
             H5Tinsert(type, "y", 2, H5T_STD_U16LE);
             H5Tinsert(type, "p", 4, H5T_STD_I16LE);
             H5Tinsert(type, "t", 8, H5T_STD_I64LE);
             file.dataset("/CD/events", {100}, {.type = type, .chunk = 100, .filters = filter(36559)});
             H5Tclose(type);
           })},
      }};
}

}  // namespace esi::test

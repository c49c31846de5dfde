#include "support/hdf5_layouts.hpp"

#include <algorithm>
#include <cstddef>

namespace esi::test {
namespace {

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) / 1e6; }

struct MetavisionRecord {
  std::uint16_t x, y;
  std::int16_t p;
  std::int64_t t_us;
};

hid_t metavision_record_type() {
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(MetavisionRecord));
  H5Tinsert(type, "x", offsetof(MetavisionRecord, x), H5T_NATIVE_UINT16);
  H5Tinsert(type, "y", offsetof(MetavisionRecord, y), H5T_NATIVE_UINT16);
  H5Tinsert(type, "p", offsetof(MetavisionRecord, p), H5T_NATIVE_INT16);
  H5Tinsert(type, "t", offsetof(MetavisionRecord, t_us), H5T_NATIVE_INT64);
  return type;
}

template <class T, class Get>
std::vector<T> values_of(std::span<const Event> events, Get get) {
  std::vector<T> values;
  values.reserve(events.size());
  for (const Event& event : events) values.push_back(static_cast<T>(get(event)));
  return values;
}

void add_attribute(Hdf5Writer& file, const std::string& object, const std::string& name, hid_t type,
                   hid_t space, const void* value) {
  const hid_t owner = H5Oopen(file.id(), object.c_str(), H5P_DEFAULT);
  const hid_t id = H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(id, type, value);
  H5Aclose(id);
  H5Oclose(owner);
  H5Sclose(space);
}

}  // namespace

std::vector<MvsecRow> mvsec_rows(std::span<const Event> events) {
  std::vector<MvsecRow> rows;
  rows.reserve(events.size());
  for (const Event& event : events) {
    rows.push_back({double(event.x), double(event.y), seconds(event.t_us), event.on ? 1.0 : -1.0});
  }
  return rows;
}

void write_mvsec(Hdf5Writer& file, const std::string& path, const std::vector<MvsecRow>& rows,
                 hsize_t chunk) {
  const auto chunked = [&](hid_t properties) {
    if (rows.empty()) return;
    const hsize_t extent[] = {std::min<hsize_t>(chunk, rows.size()), 4};
    H5Pset_chunk(properties, 2, extent);
    gzip(properties);
  };
  file.dataset(path, {rows.size(), 4}, {.type = H5T_IEEE_F64LE, .filters = chunked}, H5T_NATIVE_DOUBLE,
               rows.empty() ? nullptr : rows.data());
}

void write_images(Hdf5Writer& file, const std::string& group, const std::vector<hsize_t>& extent,
                  const std::vector<std::uint8_t>& images, const std::vector<double>& times_s,
                  const std::vector<hsize_t>& chunk) {
  const auto chunked = [&](hid_t properties) {
    if (chunk.empty()) return;
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    gzip(properties);
  };
  file.dataset(group + "image_raw", extent, {.type = H5T_STD_U8LE, .filters = chunked}, H5T_NATIVE_UINT8,
               images.data());
  file.dataset(group + "image_raw_ts", {times_s.size()}, {.type = H5T_IEEE_F64LE}, H5T_NATIVE_DOUBLE,
               times_s.data());
}

hid_t boolean_type() {
  const hid_t type = H5Tenum_create(H5T_STD_I8LE);
  const std::int8_t off = 0;
  const std::int8_t on = 1;
  H5Tenum_insert(type, "FALSE", &off);
  H5Tenum_insert(type, "TRUE", &on);
  return type;
}

void write_monash(Hdf5Writer& file, std::span<const Event> events) {
  const auto xs = values_of<std::int64_t>(events, [](const Event& event) { return event.x; });
  const auto ys = values_of<std::int64_t>(events, [](const Event& event) { return event.y; });
  const auto ts = values_of<double>(events, [](const Event& event) { return seconds(event.t_us); });
  const auto ps = values_of<std::int8_t>(events, [](const Event& event) { return event.on ? 1 : 0; });
  const hid_t boolean = boolean_type();
  file.column("/events/xs", xs, {.type = H5T_STD_I16LE});
  file.column("/events/ys", ys, {.type = H5T_STD_I16LE});
  file.dataset("/events/ts", {ts.size()}, {.type = H5T_IEEE_F64LE}, H5T_NATIVE_DOUBLE,
               ts.empty() ? nullptr : ts.data());
  file.dataset("/events/ps", {ps.size()}, {.type = boolean}, boolean, ps.empty() ? nullptr : ps.data());
  H5Tclose(boolean);
}

void write_metavision(Hdf5Writer& file, std::span<const Event> events, hsize_t chunk) {
  std::vector<MetavisionRecord> records;
  records.reserve(events.size());
  for (const Event& event : events)
    records.push_back({event.x, event.y, static_cast<std::int16_t>(event.on), event.t_us});
  const hid_t type = metavision_record_type();
  file.dataset("/CD/events", {records.size()}, {.type = type, .chunk = chunk}, type,
               records.empty() ? nullptr : records.data());
  H5Tclose(type);
}

void write_attribute(Hdf5Writer& file, const std::string& object, const std::string& name,
                     const std::vector<double>& values) {
  const hsize_t count = values.size();
  const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
  add_attribute(file, object, name, H5T_NATIVE_DOUBLE, space, values.data());
}

void write_text_attribute(Hdf5Writer& file, const std::string& object, const std::string& name,
                          const std::string& text, bool is_variable) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, is_variable ? H5T_VARIABLE : text.size());
  const char* const characters = text.c_str();
  add_attribute(file, object, name, type, H5Screate(H5S_SCALAR),
                is_variable ? static_cast<const void*>(&characters) : characters);
  H5Tclose(type);
}

}  // namespace esi::test

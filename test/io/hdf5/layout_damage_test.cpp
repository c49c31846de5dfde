// Damaged and hostile files in the layouts of MVSEC, Monash and Metavision.
#include <catch2/catch.hpp>

#include "support/hdf5_layouts.hpp"
#include "support/random_events.hpp"
#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

using Change = std::function<void(Hdf5Writer&)>;

Change replaced(const std::string& path, const std::vector<hsize_t>& extent, hid_t type) {
  return [=](Hdf5Writer& file) {
    file.remove(path);
    file.dataset(path, extent, {.type = type});
  };
}

/// Records with these fields, one behind the other.
hid_t record(const std::vector<std::pair<const char*, hid_t>>& fields, std::size_t size = 64) {
  const hid_t type = H5Tcreate(H5T_COMPOUND, size);
  std::size_t offset = 0;
  for (const auto& [name, field] : fields) {
    H5Tinsert(type, name, offset, field);
    offset += H5Tget_size(field);
  }
  return type;
}

struct Refusal {
  std::string what;
  Change change;
  std::string dataset, reason;
};

template <class Write>
void check_refusals(const std::vector<Refusal>& cases, Write write) {
  const TempFolder folder;
  for (const Refusal& test : cases) {
    INFO(test.what);
    {
      Hdf5Writer file(folder / "a.h5");
      write(file, random_events({0, 0, 240, 180}, 100, 5, 1));
      test.change(file);
    }
    CHECK_THAT(hdf5_error(folder / "a.h5"), Contains("dataset " + test.dataset) && Contains(test.reason));
  }
}

TEST_CASE("MVSEC datasets that cannot be events are refused") {
  const std::string path = "/davis/left/events";
  const hid_t wide = H5Tcopy(H5T_NATIVE_LDOUBLE);
  const std::vector<Refusal> cases = {
      {"integers", replaced(path, {100, 4}, H5T_STD_I64LE), path, "floating-point"},
      {"more than 64 bits", replaced(path, {100, 4}, wide), path, "at most 64 bits"},
      {"three columns", replaced(path, {100, 3}, H5T_IEEE_F64LE), path, "3 values per row"},
      {"one dimension", replaced(path, {400}, H5T_IEEE_F64LE), path, "1 dimensions"},
      {"no dimension", replaced(path, {}, H5T_IEEE_F64LE), path, "0 dimensions"},
      {"three dimensions", replaced(path, {100, 2, 2}, H5T_IEEE_F64LE), path, "3 dimensions"},
      {"no columns", replaced(path, {100, 0}, H5T_IEEE_F64LE), path, "values per row"},
      {"absurd columns", replaced(path, {100, hsize_t{1} << 40}, H5T_IEEE_F64LE), path, ""},
  };
  check_refusals(cases, [&](Hdf5Writer& file, const std::vector<Event>& events) {
    write_mvsec(file, path, mvsec_rows(events), 10);
  });
  H5Tclose(wide);
}

TEST_CASE("Monash columns that cannot be events are refused") {
  const hid_t wide = H5Tcopy(H5T_NATIVE_LDOUBLE);
  const std::vector<Refusal> cases = {
      {"whole times", replaced("/events/ts", {100}, H5T_STD_I64LE), "/events/ts", "times in seconds"},
      {"wide times", replaced("/events/ts", {100}, wide), "/events/ts", "at most 64 bits"},
      {"float x", replaced("/events/xs", {100}, H5T_IEEE_F64LE), "/events/xs", "floating-point"},
      {"short column", replaced("/events/ps", {99}, H5T_STD_I8LE), "/events/ps",
       "99 rows, but /events/ts has 100"},
      {"two dimensions", replaced("/events/ts", {100, 1}, H5T_IEEE_F64LE), "/events/ts", "2 dimensions"},
      {"one value", replaced("/events/ps", {}, H5T_STD_I8LE), "/events/ps", "single value"},
  };
  check_refusals(cases,
                 [](Hdf5Writer& file, const std::vector<Event>& events) { write_monash(file, events); });
  H5Tclose(wide);
}

TEST_CASE("Metavision records that cannot be events are refused") {
  const std::string path = "/CD/events";
  const auto i = H5T_STD_I32LE;
  const hid_t wide = H5Tcopy(H5T_STD_I64LE);
  H5Tset_size(wide, 16);
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, H5T_VARIABLE);
  const std::vector<hid_t> types = {
      record({{"x", i}, {"y", i}, {"p", i}}),
      record({{"x", H5T_IEEE_F32LE}, {"y", i}, {"p", i}, {"t", i}}),
      record({{"x", i}, {"y", i}, {"p", i}, {"t", H5T_IEEE_F64LE}}),
      record({{"x", i}, {"y", i}, {"p", i}, {"t", wide}}),
      record({{"x", i}, {"y", i}, {"p", i}, {"t", i}, {"text", text}}),
      record({{"x", i}, {"y", i}, {"p", i}, {"t", i}}, 1000),
      record({{"x", i}, {"y", i}, {"p", i}, {"t", i}}),
  };
  const std::vector<Refusal> cases = {
      {"no t", replaced(path, {100}, types[0]), path, "no field t"},
      {"float x", replaced(path, {100}, types[1]), path, "field x is no integer"},
      {"float t", replaced(path, {100}, types[2]), path, "field t is no integer"},
      {"128 bits", replaced(path, {100}, types[3]), path, "field t is no integer"},
      {"text", replaced(path, {100}, types[4]), path, "no numbers"},
      {"long records", replaced(path, {100}, types[5]), path, "1000 bytes"},
      {"two dimensions", replaced(path, {10, 10}, types[6]), path, "records"},
      {"one value", replaced(path, {}, types[6]), path, "records"},
      {"no records", replaced(path, {100}, H5T_STD_I64LE), path, "records"},
      {"absurd chunks",
       [&](Hdf5Writer& file) {
         file.remove(path);
         file.dataset(path, {100}, {.type = types[6], .chunk = hsize_t{1} << 25});
       },
       path, "chunks of 2147483648 bytes"},
  };
  check_refusals(
      cases, [](Hdf5Writer& file, const std::vector<Event>& events) { write_metavision(file, events, 10); });
  for (const hid_t type : types) H5Tclose(type);
  H5Tclose(text);
  H5Tclose(wide);
}

TEST_CASE("Metavision with ECF is refused with what to do") {
  const TempFolder folder;
  const hid_t type =
      record({{"x", H5T_STD_U16LE}, {"y", H5T_STD_U16LE}, {"p", H5T_STD_I16LE}, {"t", H5T_STD_I64LE}});
  {
    Hdf5Writer file(folder / "a.h5");
    file.dataset("/CD/events", {100}, {.type = type, .chunk = 10, .filters = filter(0x8ECF)});
  }
  H5Tclose(type);
  CHECK_THAT(hdf5_error(folder / "a.h5"), Contains("36559") && Contains("HDF5_PLUGIN_PATH") &&
                                              Contains("hdf5_ecf") && Contains("metavision_file_to_csv"));
}

TEST_CASE("A damaged chunk of MVSEC or Metavision costs its rows") {
  const TempFolder folder;
  const std::vector<Event> events = random_events({0, 0, 240, 180}, 100000, 5, 1);
  const hid_t type =
      record({{"x", H5T_STD_U16LE}, {"y", H5T_STD_U16LE}, {"p", H5T_STD_I16LE}, {"t", H5T_STD_I64LE}}, 14);
  {
    Hdf5Writer mvsec(folder / "mvsec.h5");
    write_mvsec(mvsec, "/davis/left/events", mvsec_rows(events), 1000);
    const hid_t id = H5Dopen2(mvsec.id(), "/davis/left/events", H5P_DEFAULT);
    const hsize_t offset[] = {5000, 0};
    H5Dwrite_chunk(id, H5P_DEFAULT, 0, offset, 16, "this is not gzip");
    H5Dclose(id);
    Hdf5Writer metavision(folder / "metavision.h5");
    std::string packed;
    for (const Event& event : events) {
      const std::uint16_t p = event.on ? 1 : 0;
      packed.append(reinterpret_cast<const char*>(&event.x), 2)
          .append(reinterpret_cast<const char*>(&event.y), 2);
      packed.append(reinterpret_cast<const char*>(&p), 2)
          .append(reinterpret_cast<const char*>(&event.t_us), 8);
    }
    metavision.dataset("/CD/events", {events.size()}, {.type = type, .chunk = 1000, .filters = gzip}, type,
                       packed.data());
    metavision.replace_chunk("/CD/events", 5000, "this is not gzip", 16);
  }
  H5Tclose(type);
  std::vector<Event> expected(events.begin(), events.begin() + 5000);
  expected.insert(expected.end(), events.begin() + 6000, events.end());
  for (const char* const name : {"mvsec.h5", "metavision.h5"}) {
    const Reading reading = read_hdf5(folder / name);
    CHECK(reading.events == expected);
    CHECK(reading.losses.of(Damage::corrupt_packet) == 1);
    CHECK_THAT(reading.header.notes.at(0), Contains("rows 5000 to 5999") && Contains("gzip"));
  }
}

TEST_CASE("2^60 declared rows of MVSEC, Monash or Metavision are not waited for") {
  const TempFolder folder;
  const std::vector<Event> events = random_events({0, 0, 240, 180}, 1000, 5, 1);
  const auto enlarge = [](Hdf5Writer& file, const std::string& path, std::vector<hsize_t> extent) {
    const hid_t id = H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT);
    REQUIRE(H5Dset_extent(id, extent.data()) >= 0);
    H5Dclose(id);
  };
  {
    Hdf5Writer metavision(folder / "metavision.h5");
    write_metavision(metavision, events, 500);
    enlarge(metavision, "/CD/events", {hsize_t{1} << 60});
    Hdf5Writer monash(folder / "monash.h5");
    write_monash(monash, events);
    for (const auto& [name, type] : {std::pair{"xs", H5T_STD_I16LE}, std::pair{"ys", H5T_STD_I16LE},
                                     std::pair{"ts", H5T_IEEE_F64LE}, std::pair{"ps", H5T_STD_I8LE}}) {
      const std::string path = std::string("/events/") + name;
      const std::vector<double> values(1000, 1);
      monash.remove(path);
      monash.dataset(path, {1000}, {.type = type, .chunk = 500, .declared = hsize_t{1} << 60},
                     H5T_NATIVE_DOUBLE, values.data());
    }
    Hdf5Writer mvsec(folder / "mvsec.h5");
    const auto chunked = [](hid_t properties) {
      const hsize_t chunk[] = {500, 4};
      H5Pset_chunk(properties, 2, chunk);
    };
    mvsec.dataset("/davis/left/events", {hsize_t{1} << 58, 4}, {.type = H5T_IEEE_F64LE, .filters = chunked});
  }
  for (const auto& [name, count] :
       {std::pair{"metavision.h5", 1000}, std::pair{"monash.h5", 1000}, std::pair{"mvsec.h5", 0}}) {
    INFO(name);
    const Reading reading = read_hdf5(folder / name);
    CHECK(reading.events.size() == static_cast<std::size_t>(count));
    CHECK(reading.losses.of(Damage::cut_packet) == 1);
    CHECK_THAT(reading.header.notes.at(0), Contains("events are declared"));
  }
}

}  // namespace

// HDF5 files that are not read: what a person is told.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

TEST_CASE("What is not an intact HDF5 file is refused with a reason") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "whole.h5");
    write_columns(file, "/events/", Columns(1000), {.chunk = 100, .filters = gzip});
  }
  const std::string whole = content_of(folder / "whole.h5");
  CHECK_THAT(hdf5_error(folder.write("no.h5", "hello, this is not HDF5")),
             Contains("cannot be opened as HDF5"));
  CHECK_THAT(hdf5_error(folder.write("empty.h5", "")), Contains("cannot be opened as HDF5"));
  for (std::size_t size = 8; size < whole.size(); size += 61) {
    INFO(size);
    const std::string message = hdf5_error(folder.write("cut.h5", whole.substr(0, size)));
    CHECK_THAT(message, Contains("cut.h5: "));
    if (size >= 100) CHECK_THAT(message, Contains("is truncated") && Contains("copy it again"));
  }
}

TEST_CASE("An HDF5 file whose writer was killed says so and names h5clear") {
  const TempFolder folder;
  const std::string path = (folder / "a.h5").string();
  const pid_t writer = fork();
  if (writer == 0) {
    const Hdf5Writer file(path, true);
    H5Fflush(file.id(), H5F_SCOPE_GLOBAL);
    _exit(0);  // Without closing the file.
  }
  int status = 0;
  REQUIRE(waitpid(writer, &status, 0) == writer);
  CHECK_THAT(hdf5_error(path), Contains("not closed properly") && Contains("h5clear -s"));
}

TEST_CASE("HDF5 without a known layout: the message lists what was found, up to a limit") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    file.column("/davis/left/imu", {1});
    file.column("/events/x", {1});
    file.column("/bad\nname", {1});
    Hdf5Writer many(folder / "many.h5");
    for (int i = 0; i < 50; ++i) many.scalar("/values/" + std::to_string(i), i);
    const Hdf5Writer none(folder / "none.h5");
  }
  const std::string message = hdf5_error(folder / "a.h5");
  CHECK_THAT(message, Contains("datasets found: /bad?name, /davis/left/imu, /events/x;"));
  CHECK_THAT(message,
             Contains("/events/{x,y,t,p} (DSEC, TUM-VIE)") && Contains("M3ED") && Contains("e2calib"));
  const std::string long_message = hdf5_error(folder / "many.h5");
  CHECK_THAT(long_message, Contains("/values/26, ...;"));
  CHECK_THAT(long_message, !Contains("/values/27"));
  CHECK_THAT(hdf5_error(folder / "none.h5"), Contains("datasets found: none"));
}

TEST_CASE("HDF5 columns that cannot be events are refused, each by name") {
  struct Case {
    std::string what;
    std::function<void(Hdf5Writer&)> replace;  // after /events/... was written with 100 rows
    std::string dataset, reason;
  };
  const auto shaped = [](const char* path, const std::vector<hsize_t>& extent, hid_t type) {
    return [=](Hdf5Writer& file) {
      file.remove(path);
      file.dataset(path, extent, {.type = type});
    };
  };
  const hid_t wide = H5Tcopy(H5T_STD_I64LE);
  H5Tset_size(wide, 16);
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, H5T_VARIABLE);
  const std::vector<Case> cases = {
      {"float times", shaped("/events/t", {100}, H5T_IEEE_F64LE), "/events/t", "floating-point"},
      {"float x", shaped("/events/x", {100}, H5T_IEEE_F32BE), "/events/x", "floating-point"},
      {"text", shaped("/events/p", {100}, text), "/events/p", "does not hold integers"},
      {"128 bits", shaped("/events/t", {100}, wide), "/events/t",
       "does not hold integers of at most 64 bits"},
      {"short column", shaped("/events/y", {99}, H5T_STD_U16LE), "/events/y",
       "has 99 rows, but /events/t has 100"},
      {"two dimensions", shaped("/events/x", {100, 1}, H5T_STD_U16LE), "/events/x", "2 dimensions"},
      {"three dimensions", shaped("/events/x", {100, 1, 1}, H5T_STD_U16LE), "/events/x", "3 dimensions"},
      {"one value", shaped("/events/x", {}, H5T_STD_U16LE), "/events/x", "single value"},
      {"float offset", shaped("/t_offset", {1}, H5T_IEEE_F64LE), "/t_offset", "floating-point"},
      {"two offsets", shaped("/t_offset", {2}, H5T_STD_I64LE), "/t_offset", "2 values"},
  };
  const TempFolder folder;
  for (const Case& test : cases) {
    INFO(test.what);
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/events/", Columns(100));
      file.scalar("/t_offset", 0);
      test.replace(file);
    }
    CHECK_THAT(hdf5_error(folder / "a.h5"), Contains("dataset " + test.dataset) && Contains(test.reason));
  }
  H5Tclose(wide);
  H5Tclose(text);
}

TEST_CASE("HDF5 times that 64 bits cannot hold are an error that names the row") {
  const TempFolder folder;
  for (const bool is_unsigned : {false, true}) {
    {
      Hdf5Writer file(folder / "a.h5");
      Columns columns(20000);
      if (!is_unsigned) columns.t[9000] = std::numeric_limits<std::int64_t>::max() - 5;
      write_columns(file, "/events/", columns);
      file.scalar("/t_offset", is_unsigned ? 0 : 10);
      if (is_unsigned) {
        std::vector<std::uint64_t> times(20000, 0);
        times[9000] = std::uint64_t{1} << 63;
        file.remove("/events/t");
        file.dataset("/events/t", {20000}, {.type = H5T_STD_U64LE}, H5T_NATIVE_UINT64, times.data());
      }
    }
    CHECK_THAT(hdf5_error(folder / "a.h5"), Contains("dataset /events/t, row 9000") && Contains("64 bits"));
  }
}

/// The messages for files with these filters, as a process sees them that has no plugins.
std::vector<std::string> errors_without_plugins(const TempFolder& folder,
                                                const std::vector<H5Z_filter_t>& ids) {
  const pid_t child = fork();
  if (child == 0) {
    // HDF5 looks at the variable when it starts; closing the library makes it start again.
    setenv("HDF5_PLUGIN_PATH", folder.path().c_str(), 1);
    H5close();
    for (const H5Z_filter_t id : ids) {
      {
        Hdf5Writer file(folder / "a.h5");
        write_columns(file, "/events/", Columns(100), {.chunk = 50, .filters = filter(id)});
      }
      folder.write(std::to_string(id), hdf5_error(folder / "a.h5"));
    }
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(status == 0);
  std::vector<std::string> errors;
  errors.reserve(ids.size());
  for (const H5Z_filter_t id : ids) errors.push_back(content_of(folder / std::to_string(id)));
  return errors;
}

TEST_CASE("A missing HDF5 filter is named, with its package; gzip and LZF need none") {
  const TempFolder folder;
  const auto errors = errors_without_plugins(folder, {32001, 0x8ECF, 32015, 32000, H5Z_FILTER_DEFLATE});
  CHECK_THAT(errors[0], Contains("filter 32001 (Blosc)") && Contains("hdf5-filter-plugin-blosc-serial"));
  CHECK_THAT(errors[1], Contains("filter 36559") && Contains("without ECF"));
  CHECK_THAT(errors[2], Contains("filter 32015") && Contains("HDF5_PLUGIN_PATH"));
  CHECK(errors[3].empty());
  CHECK(errors[4].empty());
}

TEST_CASE("A contiguous HDF5 column longer than its file is refused") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", Columns(0x5A5));
  }
  std::string content = content_of(folder / "a.h5");
  const std::string length("\xA5\x05\0\0\0\0\0\0", 8);
  for (const std::string& claimed :
       {std::string("\0\0\0\0\0\0\0\x10", 8), std::string("\0\0\1\0\0\0\0\0", 8)}) {
    std::string changed = content;
    for (std::size_t at = 0; (at = changed.find(length, at)) != std::string::npos;)
      changed.replace(at, 8, claimed);
    CHECK_THAT(hdf5_error(folder.write("long.h5", changed)), Contains("dataset /x"));
  }
}

TEST_CASE("HDF5 chunks of absurd size are refused before they are read") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    for (const char* const path : {"/x", "/y", "/t", "/p"}) file.dataset(path, {3}, {.chunk = 500000000});
  }
  CHECK_THAT(hdf5_error(folder / "a.h5"), Contains("dataset /x has chunks of 4000000000 bytes"));
}

TEST_CASE("HDF5 that leads into other files is refused") {
  const TempFolder folder;
  {
    Hdf5Writer other(folder / "other.h5");
    write_columns(other, "/", Columns(100));
    folder.write("other.bin", std::string(800, '\0'));
  }
  const std::string other = (folder / "other.h5").string();
  const auto link = [&](Hdf5Writer& file) {
    H5Lcreate_external(other.c_str(), "/x", file.id(), "/events/x", H5P_DEFAULT, H5P_DEFAULT);
  };
  const auto group_link = [&](Hdf5Writer& file) {
    file.remove("/events");
    H5Lcreate_external(other.c_str(), "/", file.id(), "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/elsewhere", file.id(), "/events", H5P_DEFAULT, H5P_DEFAULT);
  };
  const auto virtual_dataset = [&](Hdf5Writer& file) {
    const auto elsewhere = [&](hid_t properties) {
      const hsize_t count = 100;
      const hid_t space = H5Screate_simple(1, &count, nullptr);
      H5Pset_virtual(properties, space, other.c_str(), "/x", space);
      H5Sclose(space);
    };
    file.dataset("/events/x", {100}, {.filters = elsewhere});
  };
  const auto external_values = [&](Hdf5Writer& file) {
    const auto elsewhere = [&](hid_t p) { H5Pset_external(p, (folder / "other.bin").c_str(), 0, 800); };
    file.dataset("/events/x", {100}, {.filters = elsewhere});
  };
  struct Case {
    std::string what;
    std::function<void(Hdf5Writer&)> make_x;
    std::string reason;
  };
  const std::vector<Case> cases = {
      {"external link", link, "/events/x is a link into another file (" + other},
      {"soft link to a group elsewhere", group_link, "is a link into another file"},
      {"virtual dataset", virtual_dataset, "dataset /events/x keeps its values in other"},
      {"external values", external_values, "dataset /events/x keeps its values in other"}};
  for (const Case& test : cases) {
    INFO(test.what);
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/events/", Columns(100));
      file.remove("/events/x");
      test.make_x(file);
    }
    CHECK_THAT(hdf5_error(folder / "a.h5"), Contains(test.reason));
  }
}

TEST_CASE("HDF5 soft links within the file are followed") {
  const TempFolder folder;
  const Columns columns(100);
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/recordings/first/", columns);
    H5Lcreate_soft("/recordings/first", file.id(), "/events", H5P_DEFAULT, H5P_DEFAULT);
  }
  CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
}

}  // namespace

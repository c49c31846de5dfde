// Damaged and hostile HDF5 files: the rest is read, what is lost is counted, memory stays bounded.
#include <zlib.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

/// Most resident memory that `action` needed beyond what was there before.
std::int64_t peak_bytes(const std::function<void()>& action) {
  const auto status = [](const std::string& key) {
    std::ifstream file("/proc/self/status");
    std::string word;
    std::int64_t kibibytes = 0;
    while (file >> word && word != key) {
    }
    file >> kibibytes;
    return kibibytes * 1024;
  };
  std::ofstream("/proc/self/clear_refs") << "5";  // Sets the peak back to what is resident now.
  const std::int64_t before = status("VmRSS:");
  action();
  return status("VmHWM:") - before;
}

constexpr std::int64_t kMiB = 1 << 20;

TEST_CASE("A damaged HDF5 chunk costs its rows in all columns and is counted") {
  const TempFolder folder;
  const Columns columns(200000);
  struct Case {
    hsize_t x_chunk, t_chunk;
    std::string damaged;
    hsize_t damaged_row;
    std::size_t begin, end;  // rows lost
  };
  for (const Case& test :
       {Case{1000, 1000, "/x", 5000, 5000, 6000}, Case{4000, 1000, "/t", 9000, 8000, 12000},
        Case{1000, 4000, "/t", 196000, 196000, 200000}, Case{70000, 70000, "/x", 0, 0, 70000}}) {
    {
      Hdf5Writer file(folder / "a.h5");
      file.column("/x", columns.x, {.chunk = test.x_chunk, .filters = gzip});
      file.column("/y", columns.y, {.chunk = test.x_chunk, .filters = gzip});
      file.column("/t", columns.t, {.chunk = test.t_chunk, .filters = gzip});
      file.column("/p", columns.p);
      file.replace_chunk(test.damaged, test.damaged_row, "this is not gzip", 16);
    }
    const Reading reading = read_hdf5(folder / "a.h5");
    std::vector<Event> expected = expected_events(columns, 0, test.begin);
    const std::vector<Event> rest = expected_events(columns, test.end, columns.t.size());
    expected.insert(expected.end(), rest.begin(), rest.end());
    CHECK(reading.events == expected);
    CHECK(reading.losses.of(Damage::corrupt_packet) == 1);
    REQUIRE(reading.header.notes.size() == 1);
    CHECK_THAT(reading.header.notes[0],
               Contains("rows " + std::to_string(test.begin) + " to " + std::to_string(test.end - 1)) &&
                   Contains("dataset " + test.damaged) && Contains("gzip"));
  }
}

TEST_CASE("HDF5 checksums that differ, and chunks of a wrong size, are damage") {
  std::string small(200, '\0');
  uLongf small_size = small.size();
  const std::string ten(10, '\1');
  compress(reinterpret_cast<Bytef*>(small.data()), &small_size, reinterpret_cast<const Bytef*>(ten.data()),
           10);
  small.resize(small_size);
  std::string blosc(16, '\0');  // Version 2, format 1, stored as it is, values of 1 byte.
  blosc.replace(0, 4, "\x02\x01\x02\x01");
  struct Case {
    std::string what;
    std::function<void(hid_t)> filters;
    std::string stored;
    std::uint32_t mask;
  };
  const auto checksum = [](hid_t properties) { H5Pset_fletcher32(properties); };
  const std::vector<Case> cases = {
      {"wrong checksum", checksum, std::string(8000, 'a') + "abcd", 0},
      {"no room for a checksum", checksum, "abc", 0},
      {"gzip, too little", gzip, small, 0},
      {"gzip left out, too little", gzip, std::string(7999, 'a'), 1},
      {"LZF, too little", filter(32000),
       std::string("\x00"
                   "a",
                   2),
       0},
      {"LZF, cut literals", filter(32000),
       std::string("\x1f"
                   "abc",
                   4),
       0},
      {"LZF, cut repetition", filter(32000),
       std::string("\x00"
                   "a\xe0",
                   3),
       0},
      {"LZF, from before the beginning", filter(32000),
       std::string("\x00"
                   "a\xe0\xff\x01",
                   5),
       0},
      {"LZF, nothing", filter(32000), std::string("\x00", 1), 0},
      {"Blosc, too little", filter(32001), blosc, 0},
      {"Blosc, no header", filter(32001), "abc", 0},
      {"Blosc left out, too little", filter(32001), std::string(7999, 'a'), 1},
      {"far too long", gzip, std::string(100000, 'a'), 0},
  };
  const TempFolder folder;
  const Columns columns(3000);
  for (const Case& test : cases) {
    INFO(test.what);
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/", columns, {.chunk = 1000, .filters = test.filters});
      file.replace_chunk("/t", 1000, test.stored.data(), test.stored.size(), test.mask);
    }
    const Reading reading = read_hdf5(folder / "a.h5");
    CHECK(reading.events.size() == 2000);
    CHECK(reading.losses.of(Damage::corrupt_packet) == 1);
  }
}

/// A gzip stream of `mebibytes` zeros: fully flushed blocks are alike, so that one can be repeated.
std::string gzip_bomb(int mebibytes) {
  const std::vector<Bytef> zeros(kMiB);
  std::vector<Bytef> out(kMiB);
  z_stream stream{};
  REQUIRE(deflateInit(&stream, 9) == Z_OK);
  const auto compress_block = [&](int flush, std::size_t size) {
    stream.next_in = const_cast<Bytef*>(zeros.data());
    stream.avail_in = static_cast<uInt>(size);
    stream.next_out = out.data();
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, flush);
    return std::string(out.begin(), out.end() - stream.avail_out);
  };
  std::string bomb = compress_block(Z_FULL_FLUSH, zeros.size());
  const std::string block = compress_block(Z_FULL_FLUSH, zeros.size());
  for (int i = 1; i < mebibytes; ++i) bomb += block;
  bomb += compress_block(Z_FINISH, 0);
  deflateEnd(&stream);
  return bomb;
}

TEST_CASE("Chunks that decode to gigabytes take no such memory") {
  std::string lzf(
      "\x00"
      "a",
      2);
  while (lzf.size() < 1000000) lzf += std::string("\xe0\xff\x00", 3);  // 264 times the byte before
  std::string blosc("\x02\x01\x00\x08\xff\xff\xff\x7f\x00\x00\x01\x00\x10\x00\x00\x00", 16);
  blosc.resize(1000);
  const TempFolder folder;
  for (const auto& [id, bomb] : {std::pair<H5Z_filter_t, std::string>{H5Z_FILTER_DEFLATE, gzip_bomb(1000)},
                                 std::pair<H5Z_filter_t, std::string>{32000, lzf},
                                 std::pair<H5Z_filter_t, std::string>{32001, blosc}}) {
    INFO(id);
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/", Columns(196608), {.chunk = 65536, .filters = filter(id)});
      file.replace_chunk("/t", 65536, bomb.data(), bomb.size());
    }
    Reading reading;
    CHECK(peak_bytes([&] { reading = read_hdf5(folder / "a.h5"); }) < 100 * kMiB);
    CHECK(reading.events.size() == 131072);
    CHECK(reading.losses.of(Damage::corrupt_packet) == 1);
  }
}

TEST_CASE("2^60 declared HDF5 events are not waited for") {
  const TempFolder folder;
  const Columns columns(2500);
  for (const bool is_compressed : {false, true}) {
    for (const bool latest : {false, true}) {
      {
        Hdf5Writer file(folder / "a.h5", latest);
        Storage storage{.chunk = 1000, .declared = hsize_t{1} << 60};
        if (is_compressed) storage.filters = gzip;
        write_columns(file, "/events/", columns, storage);
      }
      Reading reading;
      CHECK(peak_bytes([&] { reading = read_hdf5(folder / "a.h5"); }) < 50 * kMiB);
      // The last chunk is stored whole: behind the written rows it holds zeros.
      REQUIRE(reading.events.size() == 3000);
      CHECK(std::equal(reading.events.begin(), reading.events.begin() + 2500,
                       expected_events(columns).begin()));
      CHECK(reading.losses.of(Damage::cut_packet) == 1);
      CHECK(reading.losses.of(Damage::corrupt_packet) == 0);
      CHECK_THAT(reading.header.notes.at(0), Contains("1152921504606846976 events are declared"));
    }
  }
}

TEST_CASE("A hole in one HDF5 column ends the recording there") {
  const TempFolder folder;
  const Columns columns(100000);
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns, {.chunk = 1000});
    file.remove("/y");
    file.column("/y", {columns.y.begin(), columns.y.begin() + 77000}, {.chunk = 7000, .declared = 100000});
  }
  const Reading reading = read_hdf5(folder / "a.h5");
  CHECK(reading.events == expected_events(columns, 0, 77000));
  CHECK(reading.losses.of(Damage::cut_packet) == 1);
}

TEST_CASE("HDF5 columns that were declared and never written hold no events") {
  const TempFolder folder;
  for (const hsize_t chunk : {0, 100}) {
    {
      Hdf5Writer file(folder / "a.h5");
      for (const char* const path : {"/x", "/y", "/t", "/p"}) file.dataset(path, {1000}, {.chunk = chunk});
    }
    const Reading reading = read_hdf5(folder / "a.h5");
    CHECK(reading.events.empty());
    CHECK(reading.losses.of(Damage::cut_packet) == 1);
  }
}

}  // namespace

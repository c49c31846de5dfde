// How the columns are stored must not matter, and each chunk is decoded once.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

#include "esi/io/hdf5/dataset.hpp"
#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;

int decoded_chunks = 0;

/// A filter that changes nothing and counts how often it decodes.
std::size_t count_decoding(unsigned flags, std::size_t /*values_count*/, const unsigned* /*values*/,
                           std::size_t bytes, std::size_t* /*buffer_size*/, void** /*buffer*/) {
  if ((flags & H5Z_FLAG_REVERSE) != 0) ++decoded_chunks;
  return bytes;
}

constexpr H5Z_filter_t kCountingFilter = 300;  // The range for tests is 256 to 511.

void add_counting_filter(hid_t properties) {
  const H5Z_class2_t filter = {H5Z_CLASS_T_VERS, kCountingFilter, 1,       1,
                               "counts",         nullptr,         nullptr, count_decoding};
  H5Zregister(&filter);
  H5Pset_filter(properties, kCountingFilter, 0, 0, nullptr);
}

void deflate_shuffle_checksum(hid_t properties) {
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, 4);
  H5Pset_fletcher32(properties);
}

TEST_CASE("HDF5 events are the same however they are stored") {
  const std::vector<std::pair<std::string, Storage>> ways = {
      {"contiguous", {}},
      {"chunks", {.chunk = 1000}},
      {"one large chunk", {.chunk = 200000}},
      {"tiny chunks", {.chunk = 3}},
      {"compressed", {.chunk = 4096, .filters = deflate_shuffle_checksum}},
      {"compressed but for the cut chunk at the end",
       {.chunk = 4096,
        .filters =
            [](hid_t p) {
              deflate_shuffle_checksum(p);
              H5Pset_chunk_opts(p, H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS);
            }}},
      {"space taken early",
       {.chunk = 1000, .filters = [](hid_t p) { H5Pset_alloc_time(p, H5D_ALLOC_TIME_EARLY); }}},
  };
  const TempFolder folder;
  for (const auto& [name, storage] : ways) {
    for (const bool latest : {false, true}) {
      INFO(name << (latest ? ", latest format" : ", oldest format"));
      const Columns columns(name == "tiny chunks" ? 20000 : 150001);
      {
        Hdf5Writer file(folder / "a.h5", latest);
        write_columns(file, "/events/", columns, storage);
      }
      const Reading reading = read_hdf5(folder / "a.h5");
      CHECK(reading.events == expected_events(columns));
      CHECK(reading.largest_packet == kPacketEvents);
      CHECK_FALSE(reading.losses.any());
    }
  }
}

TEST_CASE("HDF5 datasets that lie within their header are read") {
  const TempFolder folder;
  const Columns columns(500);
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", columns, {.filters = [](hid_t p) { H5Pset_layout(p, H5D_COMPACT); }});
  }
  CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
}

TEST_CASE("Every HDF5 chunk is decoded once, though the columns' chunks differ") {
  struct Case {
    std::int64_t events;
    hsize_t x, y, t, p;  // lengths of the chunks
  };
  const TempFolder folder;
  for (const Case& test :
       {Case{200001, 1000, 1500, 4096, 777}, Case{200001, 65536, 65536, 65536, 65536},
        Case{200001, 150000, 70000, 1000, 200001}, Case{2500001, 8192, 10000, 8192, 2200000}}) {
    const Columns columns(test.events);
    const auto storage = [](hsize_t chunk, hid_t type) {
      return Storage{.type = type, .chunk = chunk, .filters = add_counting_filter};
    };
    {
      Hdf5Writer file(folder / "a.h5");
      file.column("/x", columns.x, storage(test.x, H5T_STD_U16LE));
      file.column("/y", columns.y, storage(test.y, H5T_STD_U16LE));
      file.column("/t", columns.t, storage(test.t, H5T_STD_I64LE));
      file.column("/p", columns.p, storage(test.p, H5T_STD_U8LE));
    }
    decoded_chunks = 0;
    CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
    int chunks = 0;
    for (const hsize_t length : {test.x, test.y, test.t, test.p}) {
      chunks += static_cast<int>((static_cast<hsize_t>(test.events) + length - 1) / length);
    }
    CHECK(decoded_chunks == chunks);
  }
}

TEST_CASE("A decoded HDF5 chunk is kept for the rows that follow") {
  const TempFolder folder;
  const Columns columns(1000);
  std::uint64_t address = 0;
  {
    Hdf5Writer file(folder / "a.h5");
    file.column("/t", columns.t, {.chunk = 1000, .filters = gzip});
    const hid_t dataset = H5Dopen2(file.id(), "/t", H5P_DEFAULT);
    haddr_t chunk = 0;
    const hsize_t row = 0;
    REQUIRE(H5Dget_chunk_info_by_coord(dataset, &row, nullptr, &chunk, nullptr) >= 0);
    address = chunk;
    H5Dclose(dataset);
  }
  ByteSource bytes(folder / "a.h5");
  const Hdf5File file(bytes);
  Hdf5Dataset dataset(file, "/t");
  std::vector<std::int64_t> values(1000);
  CHECK(dataset.read(0, 300, H5T_NATIVE_INT64, values.data()) == std::nullopt);
  std::fstream(folder / "a.h5", std::ios::in | std::ios::out | std::ios::binary)
      .seekp(static_cast<std::streamoff>(address))
      .write("damaged since", 13);
  CHECK(dataset.read(300, 700, H5T_NATIVE_INT64, values.data() + 300) == std::nullopt);
  CHECK(values == columns.t);
}

TEST_CASE("An LZF or Blosc chunk that was stored as it is, is read as it is") {
  // Writers leave a chunk uncompressed that would not shrink, and say so in the chunk's filter mask.
  const TempFolder folder;
  const Columns columns(4096);
  for (const H5Z_filter_t id : {32000, 32001}) {
    {
      Hdf5Writer file(folder / "a.h5");
      write_columns(file, "/", columns, {.chunk = 4096, .filters = filter(id)});
      file.replace_chunk("/t", 0, columns.t.data(), columns.t.size() * sizeof(columns.t[0]), 1);
    }
    CHECK(read_hdf5(folder / "a.h5").events == expected_events(columns));
  }
}

TEST_CASE("Rows of a two-dimensional HDF5 dataset are read, chunks or not") {
  const TempFolder folder;
  for (const bool is_chunked : {false, true}) {
    const hsize_t chunk[] = {3, 4};
    const auto chunked = [&](hid_t properties) {
      if (!is_chunked) return;
      H5Pset_chunk(properties, 2, chunk);
      H5Pset_deflate(properties, 1);
    };
    double values[40];
    for (int i = 0; i < 40; ++i) values[i] = i / 8.0;
    {
      Hdf5Writer file(folder / "a.h5");
      file.dataset("/davis/left/events", {10, 4}, {.type = H5T_IEEE_F64BE, .filters = chunked},
                   H5T_NATIVE_DOUBLE, values);
    }
    ByteSource bytes(folder / "a.h5");
    const Hdf5File file(bytes);
    Hdf5Dataset dataset(file, "/davis/left/events");
    CHECK(dataset.rows() == 10);
    CHECK(dataset.shape().values_per_row() == 4);
    CHECK(dataset.shape().chunk_rows() == (is_chunked ? 3 : 0));
    CHECK(dataset.first_gap(2, 10) == 10);
    double read[20];
    CHECK(dataset.read(4, 5, H5T_NATIVE_DOUBLE, read) == std::nullopt);
    CHECK(std::equal(std::begin(read), std::end(read), values + 16));
  }
}

}  // namespace

#include <hdf5.h>

#include "io/writing/writer_fixtures.hpp"

using esi::Event;
using esi::test::TempFolder;

namespace {

/// A dataset of a file, as libhdf5 alone sees it.
class Dataset {
 public:
  Dataset(const std::filesystem::path& file, const char* path)
      : file_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)),
        id_(H5Dopen2(file_, path, H5P_DEFAULT)),
        creation_(H5Dget_create_plist(id_)) {
    REQUIRE(id_ >= 0);
  }
  ~Dataset() {
    H5Pclose(creation_);
    H5Dclose(id_);
    H5Fclose(file_);
  }
  Dataset(const Dataset&) = delete;
  Dataset& operator=(const Dataset&) = delete;

  bool has_type(hid_t type) const {
    const hid_t stored = H5Dget_type(id_);
    const bool is_equal = H5Tequal(stored, type) > 0;
    H5Tclose(stored);
    return is_equal;
  }

  hsize_t chunk() const {
    hsize_t rows = 0;
    H5Pget_chunk(creation_, 1, &rows);
    return rows;
  }

  std::vector<H5Z_filter_t> filters() const {
    std::vector<H5Z_filter_t> filters;
    for (unsigned i = 0; i < static_cast<unsigned>(H5Pget_nfilters(creation_)); ++i) {
      std::size_t values = 0;
      unsigned flags = 0, config = 0;
      filters.push_back(H5Pget_filter2(creation_, i, &flags, &values, nullptr, 0, nullptr, &config));
    }
    return filters;
  }

  std::vector<std::int64_t> values() const {
    const hid_t space = H5Dget_space(id_);
    std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Sclose(space);
    REQUIRE(H5Dread(id_, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    return values;
  }

 private:
  hid_t file_, id_, creation_;
};

}  // namespace

TEST_CASE("A DSEC file has the columns' types, chunks, and filters that every HDF5 has") {
  const TempFolder folder;
  const auto path = folder / "a.h5";
  esi::test::write_recording(path, {{{5, 1, 2, true}}, {}}, {{346, 260}, 1234567890123456, ""});
  struct Row {
    const char* dataset;
    hid_t type;
  };
  const std::vector<Row> rows = {{"/events/x", H5T_STD_U16LE},
                                 {"/events/y", H5T_STD_U16LE},
                                 {"/events/p", H5T_STD_U8LE},
                                 {"/events/t", H5T_STD_U64LE},
                                 {"/ms_to_idx", H5T_STD_U64LE}};
  for (const Row& row : rows) {
    INFO(row.dataset);
    const Dataset dataset(path, row.dataset);
    CHECK(dataset.has_type(row.type));
    CHECK(dataset.chunk() == 65536);
    CHECK(dataset.filters() == std::vector<H5Z_filter_t>{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE});
  }
  CHECK(Dataset(path, "/events/t").values() == std::vector<std::int64_t>{5});
  CHECK(Dataset(path, "/t_offset").values() == std::vector<std::int64_t>{1234567890123456});
  CHECK(Dataset(path, "/t_offset").has_type(H5T_STD_I64LE));
}

TEST_CASE("Each entry of a DSEC file's index is the first event that is not before its millisecond") {
  const int gap_us = GENERATE(2, 300, 1000, 5000);
  const TempFolder folder;
  auto events = esi::test::random_events({0, 0, 346, 260}, 70000, gap_us, 9);
  for (Event& event : events) event.t_us += 2500;
  esi::test::write_recording(folder / "a.h5", {events, {}});
  const auto index = Dataset(folder / "a.h5", "/ms_to_idx").values();
  REQUIRE(index.size() == static_cast<std::size_t>(events.back().t_us / 1000 + 1));
  std::size_t wrong = index[0] == 0 ? 0 : 1;
  for (std::size_t ms = 0; ms < index.size(); ++ms) {
    const auto i = static_cast<std::size_t>(index[ms]);
    const auto boundary_us = static_cast<std::int64_t>(ms) * 1000;
    if (!(events.at(i).t_us >= boundary_us && (i == 0 || events[i - 1].t_us < boundary_us))) ++wrong;
  }
  CHECK(wrong == 0);
}

TEST_CASE("The index of a DSEC file without events still has its first entry") {
  const TempFolder folder;
  esi::test::write_recording(folder / "a.h5", {});
  CHECK(Dataset(folder / "a.h5", "/ms_to_idx").values() == std::vector<std::int64_t>{0});
}

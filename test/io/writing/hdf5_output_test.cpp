#include "esi/io/writing/hdf5_output.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using esi::Hdf5Handle;
using esi::Hdf5Lock;
using esi::Hdf5Output;
using esi::test::TempFolder;

namespace {

constexpr hsize_t kValues = 100000;

/// Uncompressed numbers whose place in the file HDF5 sets aside at once.
Hdf5Handle make_dataset(const Hdf5Output& output) {
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  const Hdf5Handle space(H5Screate_simple(1, &kValues, nullptr));
  return Hdf5Handle(H5Dcreate2(output.id(), "/numbers", H5T_STD_I32LE, space.get(), H5P_DEFAULT,
                               creation.get(), H5P_DEFAULT));
}

}  // namespace

TEST_CASE("An HDF5 file is as long as HDF5 has set aside, even where nothing was written") {
  const TempFolder folder;
  Hdf5Output output(folder / "a.h5");
  make_dataset(output);
  CHECK_FALSE(std::filesystem::exists(folder / "a.h5"));
  output.commit();
  CHECK(esi::test::names_in(folder.path()) == std::vector<std::string>{"a.h5"});
  CHECK(std::filesystem::file_size(folder / "a.h5") > kValues * sizeof(std::int32_t));
  const Hdf5Lock lock;
  const Hdf5Handle file(H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  CHECK(file);
}

TEST_CASE("HDF5 reads back what it has written into a file under construction") {
  const TempFolder folder;
  Hdf5Output output(folder / "a.h5");
  Hdf5Handle dataset = make_dataset(output);
  std::vector<std::int32_t> numbers(kValues), found(kValues, -1);
  std::iota(numbers.begin(), numbers.end(), 0);
  const Hdf5Lock lock;
  CHECK(H5Dwrite(dataset.get(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0);
  CHECK(H5Dread(dataset.get(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, found.data()) >= 0);
  CHECK((found == numbers));
}

TEST_CASE("HDF5 is not told of a failed write, which check and commit throw") {
  const TempFolder folder;
  Hdf5Output output(folder / "a.h5");
  Hdf5Handle dataset = make_dataset(output);
  const std::vector<std::int32_t> numbers(kValues);
  const esi::test::FileSizeLimit limit(1000);
  const Hdf5Lock lock;
  CHECK(H5Dwrite(dataset.get(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0);
  CHECK_THROWS_WITH(output.check(), Catch::Contains("a.h5: ") && Catch::Contains("File too large"));
  CHECK_THROWS_WITH(output.commit(), Catch::Contains("File too large"));
  CHECK_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST_CASE("What HDF5 itself refuses is an error with its reason") {
  const TempFolder folder;
  const Hdf5Output output(folder / "a.h5");
  const Hdf5Lock lock;
  CHECK_NOTHROW(output.check(0));
  const hid_t none = H5Dopen2(output.id(), "/none", H5P_DEFAULT);
  CHECK_THROWS_WITH(output.check(none), Catch::Contains("a.h5: HDF5 cannot write it ("));
}

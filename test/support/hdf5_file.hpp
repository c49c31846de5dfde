#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace esi::test {

/// How a dataset is stored.
struct Storage {
  hid_t type = H5T_STD_I64LE;
  hsize_t chunk = 0;     ///< values; 0: contiguous
  hsize_t declared = 0;  ///< values that the dataset claims to have; 0: as many as are written
  std::function<void(hid_t)> filters = [](hid_t /*properties*/) {};
};

/// Before the first HDF5 call: unloading the Blosc plugin at exit would look like a leak.
inline const herr_t kNoCleaningAtExit = H5dont_atexit();

inline void gzip(hid_t properties) { H5Pset_deflate(properties, 4); }

/// A filter by its number, whether it is installed or not.
inline std::function<void(hid_t)> filter(H5Z_filter_t id) {
  return [id](hid_t properties) { H5Pset_filter(properties, id, H5Z_FLAG_OPTIONAL, 0, nullptr); };
}

/// An HDF5 file under construction, written through the C API alone. Closed by the destructor.
class Hdf5Writer {
 public:
  /// `latest`: superblock 3 and the chunk indexes of HDF5 1.10, instead of the oldest that will do.
  explicit Hdf5Writer(const std::filesystem::path& path, bool latest = false) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (latest) H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    file_ = checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
    H5Pclose(access);
    intermediate_ = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(intermediate_, 1);
  }
  ~Hdf5Writer() {
    H5Pclose(intermediate_);
    H5Fclose(file_);
  }
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  hid_t id() const { return file_; }

  /// A dataset of any shape (none: a scalar). Without values nothing is written.
  void dataset(const std::string& path, const std::vector<hsize_t>& extent, const Storage& storage,
               hid_t memory_type = H5I_INVALID_HID, const void* values = nullptr) {
    const std::vector<hsize_t> unlimited(extent.size(), H5S_UNLIMITED);
    const hid_t space = extent.empty() ? H5Screate(H5S_SCALAR)
                                       : H5Screate_simple(static_cast<int>(extent.size()), extent.data(),
                                                          storage.chunk > 0 ? unlimited.data() : nullptr);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    if (storage.chunk > 0) H5Pset_chunk(properties, 1, &storage.chunk);
    storage.filters(properties);
    const hid_t id =
        checked(H5Dcreate2(file_, path.c_str(), storage.type, space, intermediate_, properties, H5P_DEFAULT));
    if (values != nullptr) checked(H5Dwrite(id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
    if (storage.declared > 0) checked(H5Dset_extent(id, &storage.declared));
    H5Dclose(id);
    H5Pclose(properties);
    H5Sclose(space);
  }

  void column(const std::string& path, const std::vector<std::int64_t>& values, const Storage& storage = {}) {
    dataset(path, {values.size()}, storage, H5T_NATIVE_INT64, values.empty() ? nullptr : values.data());
  }

  void scalar(const std::string& path, std::int64_t value) {
    dataset(path, {}, {}, H5T_NATIVE_INT64, &value);
  }

  void remove(const std::string& path) { checked(H5Ldelete(file_, path.c_str(), H5P_DEFAULT)); }

  /// Replaces a stored chunk, as it is in the file. Bit i of `mask` says that filter i was left out.
  void replace_chunk(const std::string& path, hsize_t row, const void* stored, std::size_t bytes,
                     std::uint32_t mask = 0) {
    const hid_t id = checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
    checked(H5Dwrite_chunk(id, H5P_DEFAULT, mask, &row, bytes, stored));
    H5Dclose(id);
  }

 private:
  template <class Id>
  static Id checked(Id id) {
    if (id < 0) throw std::runtime_error("the test's own HDF5 file cannot be written");
    return id;
  }

  hid_t file_ = H5I_INVALID_HID;
  hid_t intermediate_ = H5I_INVALID_HID;
};

/// The four columns of n events: distinct enough that a shifted or swapped column shows.
struct Columns {
  std::vector<std::int64_t> x, y, t, p;

  explicit Columns(std::int64_t n) {
    for (std::int64_t i = 0; i < n; ++i) {
      x.push_back(i * 7 % 346);
      y.push_back(i * 13 % 260);
      t.push_back(i / 3 * 2);
      p.push_back(i * i / 5 % 2);
    }
  }
};

/// `group` ends in "/".
inline void write_columns(Hdf5Writer& file, const std::string& group, const Columns& columns,
                          const Storage& storage = {}) {
  file.column(group + "x", columns.x, storage);
  file.column(group + "y", columns.y, storage);
  file.column(group + "t", columns.t, storage);
  file.column(group + "p", columns.p, storage);
}

}  // namespace esi::test

#include "esi/io/writing/hdf5_column_writer.hpp"

namespace esi {
namespace {

constexpr unsigned kDeflateLevel = 4;  // HDF5's own default

hid_t stored_type(std::uint8_t /*value*/) { return H5T_STD_U8LE; }
hid_t stored_type(std::uint16_t /*value*/) { return H5T_STD_U16LE; }
hid_t stored_type(std::uint64_t /*value*/) { return H5T_STD_U64LE; }

hid_t memory_type(std::uint8_t /*value*/) { return H5T_NATIVE_UINT8; }
hid_t memory_type(std::uint16_t /*value*/) { return H5T_NATIVE_UINT16; }
hid_t memory_type(std::uint64_t /*value*/) { return H5T_NATIVE_UINT64; }

/// Without times of creation and change, which would differ from run to run.
Hdf5Handle dataset_creation(const Hdf5Output& output) {
  Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE));
  output.check(H5Pset_obj_track_times(creation.get(), false));
  return creation;
}

Hdf5Handle link_creation(const Hdf5Output& output) {
  Hdf5Handle creation(H5Pcreate(H5P_LINK_CREATE));
  output.check(H5Pset_create_intermediate_group(creation.get(), 1));
  return creation;
}

}  // namespace

template <class Value>
Hdf5ColumnWriter<Value>::Hdf5ColumnWriter(Hdf5Output& output, const std::string& path) : output_(&output) {
  const Hdf5Lock lock;
  const Hdf5Handle creation = dataset_creation(output);
  const hsize_t chunk = kChunkRows;
  output.check(H5Pset_chunk(creation.get(), 1, &chunk));
  output.check(H5Pset_shuffle(creation.get()));
  output.check(H5Pset_deflate(creation.get(), kDeflateLevel));
  const hsize_t none = 0, unlimited = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited));
  const Hdf5Handle links = link_creation(output);
  dataset_ = Hdf5Handle(H5Dcreate2(output.id(), path.c_str(), stored_type(Value{}), space.get(), links.get(),
                                   creation.get(), H5P_DEFAULT));
  output.check(dataset_.get());
  chunk_.reserve(kChunkRows);
}

template <class Value>
void Hdf5ColumnWriter<Value>::finish() {
  flush();
  dataset_ = Hdf5Handle();
}

template <class Value>
void Hdf5ColumnWriter<Value>::flush() {
  if (chunk_.empty()) return;
  const Hdf5Lock lock;
  const hsize_t begin = written_rows_, count = chunk_.size(), end = begin + count;
  output_->check(H5Dset_extent(dataset_.get(), &end));
  const Hdf5Handle file_space(H5Dget_space(dataset_.get()));
  output_->check(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, &begin, nullptr, &count, nullptr));
  const Hdf5Handle memory_space(H5Screate_simple(1, &count, nullptr));
  output_->check(H5Dwrite(dataset_.get(), memory_type(Value{}), memory_space.get(), file_space.get(),
                          H5P_DEFAULT, chunk_.data()));
  written_rows_ = end;
  chunk_.clear();
}

template class Hdf5ColumnWriter<std::uint8_t>;
template class Hdf5ColumnWriter<std::uint16_t>;
template class Hdf5ColumnWriter<std::uint64_t>;

void write_hdf5_scalar(Hdf5Output& output, const std::string& path, std::int64_t value) {
  const Hdf5Lock lock;
  const Hdf5Handle creation = dataset_creation(output);
  const Hdf5Handle space(H5Screate(H5S_SCALAR));
  const Hdf5Handle dataset(H5Dcreate2(output.id(), path.c_str(), H5T_STD_I64LE, space.get(), H5P_DEFAULT,
                                      creation.get(), H5P_DEFAULT));
  output.check(dataset.get());
  output.check(H5Dwrite(dataset.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value));
}

}  // namespace esi

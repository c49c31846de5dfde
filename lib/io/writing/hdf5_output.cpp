#include "esi/io/writing/hdf5_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// What libhdf5 knows of an open file, and what the driver does. libhdf5 wants its own part first.
struct OpenFile {
  H5FD_t common{};
  Hdf5Output* output = nullptr;
  haddr_t allocated_bytes = 0;
  haddr_t written_bytes = 0;
};

/// What a file is opened with: libhdf5 copies it from property list to property list.
struct Target {
  Hdf5Output* output;
};

OpenFile& own(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& own(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

H5FD_t* open(const char* /*name*/, unsigned /*flags*/, hid_t access, haddr_t /*limit*/) {
  auto* const file = new OpenFile;
  file->output = static_cast<const Target*>(H5Pget_driver_info(access))->output;
  return &file->common;
}

herr_t close(H5FD_t* file) {
  delete &own(file);
  return 0;
}

herr_t query(const H5FD_t* /*file*/, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t /*type*/) { return own(file).allocated_bytes; }
haddr_t written(const H5FD_t* file, H5FD_mem_t /*type*/) { return own(file).written_bytes; }

herr_t allocate(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t bytes) {
  own(file).allocated_bytes = bytes;
  return 0;
}

herr_t read(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t position, std::size_t bytes,
            void* target) {
  own(file).output->read(position, {static_cast<std::byte*>(target), bytes});
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t position, std::size_t bytes,
             const void* source) {
  own(file).output->write(position, {static_cast<const std::byte*>(source), bytes});
  own(file).written_bytes = std::max<haddr_t>(own(file).written_bytes, position + bytes);
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  OpenFile& opened = own(file);
  if (opened.written_bytes != opened.allocated_bytes) opened.output->resize(opened.allocated_bytes);
  opened.written_bytes = opened.allocated_bytes;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "esi_output_file";
  driver.maxaddr = haddr_t{1} << 62;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(Target);
  driver.open = open;
  driver.close = close;
  driver.query = query;
  driver.get_eoa = allocated;
  driver.set_eoa = allocate;
  driver.get_eof = written;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  constexpr H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(free_lists), std::end(free_lists), std::begin(driver.fl_map));
  return driver;
}

hid_t our_driver() {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  return id;
}

}  // namespace

Hdf5Output::Hdf5Output(const std::filesystem::path& path) : name_(path.string()), part_(path) {
  const Hdf5Lock lock;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS));
  const Target target{this};
  check(H5Pset_driver(access.get(), our_driver(), &target));
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE));
  check(H5Pset_obj_track_times(creation.get(), false));
  file_ = Hdf5Handle(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()));
  check(file_.get());
}

void Hdf5Output::check() const {
  if (failure_) std::rethrow_exception(failure_);
}

void Hdf5Output::check(std::int64_t result) const {
  check();
  if (result < 0) {
    throw Error(fmt::format("{}: HDF5 cannot write it ({})", name_, last_hdf5_failure().reason));
  }
}

void Hdf5Output::commit() {
  const Hdf5Lock lock;
  check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL));
  check(H5Fclose(file_.release()));
  part_.commit();
}

// After a failure nothing is written any more, so what is read back may be garbage to libhdf5.
template <class Action>
void Hdf5Output::attempt(Action action) noexcept {
  if (failure_) return;
  try {
    action();
  } catch (const std::exception&) {
    failure_ = std::current_exception();
  }
}

void Hdf5Output::write(std::uint64_t position, std::span<const std::byte> bytes) noexcept {
  attempt([&] { part_.write_at(position, bytes); });
}

void Hdf5Output::read(std::uint64_t position, std::span<std::byte> target) noexcept {
  std::size_t done = 0;
  attempt([&] { done = part_.read_at(position, target); });
  std::fill(target.begin() + static_cast<std::ptrdiff_t>(done), target.end(), std::byte{0});
}

void Hdf5Output::resize(std::uint64_t bytes) noexcept {
  attempt([&] { part_.resize(bytes); });
}

}  // namespace esi

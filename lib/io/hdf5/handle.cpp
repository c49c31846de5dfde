#include "esi/io/hdf5/handle.hpp"

#include <mutex>

namespace esi {
namespace {

std::mutex& hdf5_mutex() {
  // All that is opened here is closed here. What HDF5 would do at exit is to unload the Blosc plugin, which
  // loses the plugin's memory. Where somebody else has used HDF5 before, this changes nothing.
  [[maybe_unused]] static const herr_t kept = H5dont_atexit();
  static std::mutex mutex;
  return mutex;
}

/// Not a recursive mutex, which knows its owner by the thread's number: a forked child has another one.
thread_local int locks_held = 0;

herr_t collect(unsigned depth, const H5E_error2_t* entry, void* data) {
  auto& failure = *static_cast<Hdf5Failure*>(data);
  if (depth == 0 && entry->desc != nullptr) failure.reason = entry->desc;
  failure.truncated |= entry->min_num == H5E_TRUNCATED;
  failure.out_of_memory |= entry->maj_num == H5E_RESOURCE && entry->min_num == H5E_NOSPACE;
  return 0;
}

}  // namespace

Hdf5Lock::Hdf5Lock() {
  if (locks_held++ == 0) hdf5_mutex().lock();
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Lock::~Hdf5Lock() {
  H5Eset_auto2(H5E_DEFAULT, print_, print_data_);
  if (--locks_held == 0) hdf5_mutex().unlock();
}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  if (this != &other) {
    close();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
  }
  return *this;
}

void Hdf5Handle::close() noexcept {
  if (id_ < 0) return;
  const Hdf5Lock lock;
  H5Idec_ref(id_);
}

Hdf5Failure last_hdf5_failure() {
  Hdf5Failure failure;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &failure);
  if (failure.reason.empty()) failure.reason = "HDF5 gives no reason";
  return failure;
}

}  // namespace esi

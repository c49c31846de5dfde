#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace esi {

/// libhdf5 is not thread-safe and prints its errors to stderr: whoever calls it holds this, which keeps other
/// threads out and the printing off. May be nested, and stays held in a child process that was forked under
/// it.
class Hdf5Lock {
 public:
  Hdf5Lock();
  ~Hdf5Lock();
  Hdf5Lock(const Hdf5Lock&) = delete;
  Hdf5Lock& operator=(const Hdf5Lock&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

/// Owns one HDF5 identifier of any kind: file, dataset, data space, type, property list.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  ~Hdf5Handle() { close(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;

  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }
  /// Gives the identifier away: the caller closes it.
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  void close() noexcept;

  hid_t id_ = H5I_INVALID_HID;
};

/// Why the last HDF5 call failed. To be asked for under the same Hdf5Lock (taking one forgets it) and before
/// the next call.
struct Hdf5Failure {
  std::string reason;  ///< the innermost entry of HDF5's error stack
  bool truncated = false;
  bool out_of_memory = false;
};
Hdf5Failure last_hdf5_failure();

}  // namespace esi

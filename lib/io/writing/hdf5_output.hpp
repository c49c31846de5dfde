#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <span>
#include <string>

#include "esi/io/hdf5/handle.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {

/// An HDF5 file under construction, as an OutputFile: it appears whole or not at all.
/// After a failed write, libhdf5 can neither close nor forget a file: it would stay open, on a full disk, as
/// long as the process lives. So libhdf5 writes through a driver of ours that never tells it of a failure but
/// keeps it; check() and commit() throw it, with the system's reason.
class Hdf5Output {
 public:
  /// Throws an Error where the file cannot be made.
  explicit Hdf5Output(const std::filesystem::path& path);
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  hid_t id() const { return file_.get(); }

  /// Throws an Error where a write has failed.
  void check() const;
  /// The same, and also where `result`, which an HDF5 call under the caller's lock gave, is negative.
  void check(std::int64_t result) const;

  /// Brings all that libhdf5 still holds to the file, closes it and puts it in place. Objects in the file
  /// must not be used any more.
  void commit();

  // What our driver calls; none of them throws.
  void write(std::uint64_t position, std::span<const std::byte> bytes) noexcept;
  void read(std::uint64_t position, std::span<std::byte> target) noexcept;
  void resize(std::uint64_t bytes) noexcept;

 private:
  template <class Action>
  void attempt(Action action) noexcept;

  std::string name_;
  OutputFile part_;
  std::exception_ptr failure_;
  Hdf5Handle file_;  ///< last, as closing it still writes
};

}  // namespace esi

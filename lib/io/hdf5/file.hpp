#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "esi/io/byte_source.hpp"
#include "esi/io/hdf5/handle.hpp"

namespace esi {

/// Whether the first bytes hold HDF5's signature: at 0, or behind a user block of 512, 1024, 2048 bytes.
bool has_hdf5_signature(std::span<const std::byte> head);

/// An HDF5 file, opened for reading. Links that lead into another file are refused.
class Hdf5File {
 public:
  /// Throws an Error for standard input, and for a file that is truncated, marked as being written, or
  /// otherwise unreadable.
  explicit Hdf5File(ByteSource& bytes);

  /// What messages call it.
  const std::string& name() const { return name_; }
  std::uint64_t size_bytes() const { return size_bytes_; }

  /// Throws an Error where the path leads into another file.
  bool has_dataset(const std::string& path) const;

  /// A group, a dataset or a type; no handle where the path leads nowhere. Throws an Error where it leads
  /// into another file. Needs Hdf5Lock.
  Hdf5Handle open_object(const std::string& path) const;

  /// `chunk_cache_bytes` is how much of the decoded chunks HDF5 keeps. Throws an Error.
  Hdf5Handle open_dataset(const std::string& path, std::size_t chunk_cache_bytes) const;

  /// The paths of the first datasets found, for messages: at most `limit`.
  std::vector<std::string> dataset_paths(std::size_t limit) const;

 private:
  void refuse_external_link(const std::string& path) const;

  std::string name_;
  std::uint64_t size_bytes_ = 0;
  std::unique_ptr<std::string> link_target_;  ///< set when a lookup meets a link into another file
  Hdf5Handle file_;
};

}  // namespace esi

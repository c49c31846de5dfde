#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "esi/core/error.hpp"

namespace esi {

/// Owns a file descriptor of the system.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;

  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }

  /// Returns 0 or an errno: network file systems and quotas may tell only here that a write failed.
  int close();

 private:
  int number_ = -1;
};

/// Writes all of `bytes`, however often the system takes only a part or is interrupted. Returns 0 or an
/// errno.
int write_fully(int file, std::string_view bytes);

/// "NAME: ACTION: reason (what to do)" for an errno.
Error system_error(const std::string& name, std::string_view action, int error_number);

}  // namespace esi

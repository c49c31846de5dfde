#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "esi/io/output/file_descriptor.hpp"

namespace esi {

/// A file that one writer at a time can hold, by an advisory lock that ends with the process, however it
/// ends.
class LockFile {
 public:
  /// Opens the file, or makes it. Throws an Error when another run holds it: `what` says of what.
  LockFile(std::filesystem::path path, const std::string& what);
  /// Takes the file away if this object made it, unless told otherwise.
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void keep_at_end() { removes_at_end_ = false; }
  void remove_at_end() { removes_at_end_ = true; }
  void replace_content(std::string_view text);
  /// Takes the file away and gives up the lock.
  void remove();

 private:
  bool open_and_lock(const std::string& what);

  std::filesystem::path path_;
  FileDescriptor file_;
  bool removes_at_end_ = false;
};

}  // namespace esi

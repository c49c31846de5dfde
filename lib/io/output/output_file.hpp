#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "esi/io/output/file_descriptor.hpp"

namespace esi {

/// A file that appears whole or not at all: written beside its place as NAME.part, every write checked, moved
/// there by commit(). Without commit() the part is removed. Throws an Error with the path and the system's
/// reason (disk full, read-only, too large). Refuses a path that is a folder or a device.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);

  /// For files that are not written from front to back. write() goes on where it was.
  void write_at(std::uint64_t position, std::span<const std::byte> bytes);
  /// What has been written there; returns how many bytes, fewer than asked for at the end.
  std::size_t read_at(std::uint64_t position, std::span<std::byte> target);
  void resize(std::uint64_t bytes);

  /// Nothing can be written after it.
  void commit();

 private:
  void write_now(std::string_view bytes);
  void flush();

  std::filesystem::path path_, part_;
  std::string buffer_;
  FileDescriptor file_;
  bool part_exists_ = false;
};

/// One whole file at once.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// The file's whole text. Throws an Error that names it; refuses more than `max_bytes`.
std::string read_text_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 28);

/// Whether anything has that name, even a link that leads nowhere.
bool is_there(const std::filesystem::path& path);

/// Takes a file away, if it is there. Throws an Error with the path and the system's reason.
void remove_file(const std::filesystem::path& path);

}  // namespace esi

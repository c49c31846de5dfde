#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace esi {

/// Bytes that don't come from a file descriptor, such as a file within an archive.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// Fills `target` from the front; returns how many bytes, 0 only at the end.
  virtual std::size_t read(std::span<std::byte> target) = 0;
  /// Why the bytes ended early; empty where they did not.
  virtual std::string damage() const = 0;
};

/// Bytes from a file or from standard input, forward only. The beginning can be looked at without taking it.
class ByteSource {
 public:
  /// `path` "-" is standard input. Throws an Error that says why it can't be read: missing, a directory, a
  /// device, no permission, a terminal, closed.
  explicit ByteSource(const std::filesystem::path& path);
  /// What lies in the file at `path` in another form.
  ByteSource(const std::filesystem::path& path, std::unique_ptr<ByteStream> stream);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// What messages call it: the path, or "standard input".
  const std::string& name() const { return name_; }
  /// Empty for standard input.
  const std::filesystem::path& path() const { return path_; }
  bool is_stdin() const { return path_.empty(); }
  /// How many bytes there will be, where that is known.
  std::optional<std::uintmax_t> file_bytes() const;

  /// The first bytes (fewer at the end of the file), which later reads return again.
  std::span<const std::byte> peek(std::size_t bytes);

  /// Fills `target` from the front; returns how many bytes, which is less than asked for only at the end.
  std::size_t read(std::span<std::byte> target);

  /// Like read, but returns as soon as some bytes are there; 0 only at the end. For streams that trickle.
  std::size_t read_some(std::span<std::byte> target);

  /// Passes over bytes; returns how many there were.
  std::size_t skip(std::size_t bytes);

  /// Bytes taken so far: the position that messages give.
  std::size_t position() const { return position_; }

  /// Once at the end: why it came too early, where that is known. The bytes before it are good.
  std::string damage() const { return stream_ ? stream_->damage() : std::string(); }

 private:
  std::size_t read_file(std::span<std::byte> target);

  std::filesystem::path path_;
  std::string name_;
  int file_ = -1;
  std::unique_ptr<ByteStream> stream_;  ///< in the file's place
  std::vector<std::byte> peeked_;
  std::size_t peeked_taken_ = 0;
  std::size_t position_ = 0;
};

}  // namespace esi

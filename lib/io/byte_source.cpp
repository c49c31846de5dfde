#include "esi/io/byte_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "esi/core/error.hpp"

namespace esi {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

void check_stdin(const std::string& name) {
  struct stat status {};
  if (fstat(STDIN_FILENO, &status) != 0) {
    throw Error(fmt::format("{}: it is closed; give a file, or pipe a recording in", name));
  }
  if (isatty(STDIN_FILENO) == 1) {
    throw Error(fmt::format("{}: it is a terminal; give a file, or pipe a recording in", name));
  }
  if (S_ISDIR(status.st_mode)) throw Error(fmt::format("{}: it is a directory; give a file", name));
}

// Before it is opened, because opening a device can do something.
void check_path(const std::string& name) {
  if (name.empty()) throw Error("'': the path is empty; give a file, or - for standard input");
  struct stat status {};
  if (stat(name.c_str(), &status) != 0) {
    const int error = errno;
    if (error == ENOENT) throw Error(fmt::format("{}: there is no such file; check the path", name));
    throw Error(fmt::format("{}: it cannot be opened ({}); check path and permissions", name, reason(error)));
  }
  if (S_ISDIR(status.st_mode)) throw Error(fmt::format("{}: it is a directory; give a file", name));
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) {
    throw Error(fmt::format("{}: it is a device or a socket; give a file or a pipe", name));
  }
}

int open_for_reading(const std::string& name) {
  check_path(name);
  int file = -1;
  do {
    file = open(name.c_str(), O_RDONLY | O_CLOEXEC);
  } while (file < 0 && errno == EINTR);
  if (file < 0) {
    throw Error(fmt::format("{}: it cannot be opened ({}); check its permissions", name, reason(errno)));
  }
  return file;
}

/// Passes over bytes without reading them, where that goes: what is wanted may lie behind gigabytes.
std::size_t seek_forward(int file, std::size_t bytes) {
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const off_t position = lseek(file, 0, SEEK_CUR);
  if (position < 0 || position >= status.st_size) return 0;
  const off_t step = static_cast<off_t>(std::min(bytes, static_cast<std::size_t>(status.st_size - position)));
  return lseek(file, step, SEEK_CUR) < 0 ? 0 : static_cast<std::size_t>(step);
}

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& path) {
  if (path == "-") {
    name_ = "standard input";
    check_stdin(name_);
    file_ = STDIN_FILENO;
    return;
  }
  path_ = path;
  name_ = path.string();
  file_ = open_for_reading(name_);
}

ByteSource::ByteSource(const std::filesystem::path& path, std::unique_ptr<ByteStream> stream)
    : path_(path), name_(path.string()), stream_(std::move(stream)) {}

ByteSource::~ByteSource() {
  if (!is_stdin() && !stream_) close(file_);
}

std::optional<std::uintmax_t> ByteSource::file_bytes() const {
  std::error_code not_a_file;
  const std::uintmax_t bytes = std::filesystem::file_size(path_, not_a_file);
  return stream_ || not_a_file ? std::nullopt : std::optional(bytes);
}

std::size_t ByteSource::read_file(std::span<std::byte> target) {
  if (stream_) return stream_->read(target);
  while (true) {
    const ssize_t n = ::read(file_, target.data(), target.size());
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno == EAGAIN) {  // whoever shares standard input has set it to non-blocking
      pollfd wait{file_, POLLIN, 0};
      poll(&wait, 1, -1);
    } else if (errno != EINTR) {
      throw Error(fmt::format("{}: reading failed at byte {} ({}); check the disk or the pipe", name_,
                              position_ + peeked_.size() - peeked_taken_, reason(errno)));
    }
  }
}

std::span<const std::byte> ByteSource::peek(std::size_t bytes) {
  peeked_.erase(peeked_.begin(), peeked_.begin() + static_cast<std::ptrdiff_t>(peeked_taken_));
  peeked_taken_ = 0;
  std::size_t held = peeked_.size();
  if (held < bytes) peeked_.resize(bytes);
  while (held < bytes) {
    const std::size_t n = read_file(std::span(peeked_).subspan(held));
    if (n == 0) break;
    held += n;
  }
  peeked_.resize(held);
  return std::span(peeked_).first(std::min(held, bytes));
}

std::size_t ByteSource::read_some(std::span<std::byte> target) {
  if (target.empty()) return 0;
  std::size_t n = std::min(target.size(), peeked_.size() - peeked_taken_);
  if (n > 0) {
    std::memcpy(target.data(), peeked_.data() + peeked_taken_, n);
    peeked_taken_ += n;
  } else {
    n = read_file(target);
  }
  position_ += n;
  return n;
}

std::size_t ByteSource::read(std::span<std::byte> target) {
  std::size_t filled = 0;
  while (filled < target.size()) {
    const std::size_t n = read_some(target.subspan(filled));
    if (n == 0) break;
    filled += n;
  }
  return filled;
}

std::size_t ByteSource::skip(std::size_t bytes) {
  std::array<std::byte, 65536> scratch;
  std::size_t skipped = std::min(bytes, peeked_.size() - peeked_taken_);
  peeked_taken_ += skipped;
  if (!stream_ && bytes - skipped > scratch.size()) skipped += seek_forward(file_, bytes - skipped);
  position_ += skipped;
  while (skipped < bytes) {
    const std::size_t n = read_some(std::span(scratch).first(std::min(scratch.size(), bytes - skipped)));
    if (n == 0) break;
    skipped += n;
  }
  return skipped;
}

}  // namespace esi

#include "esi/io/output/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>

namespace esi {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A rename would replace a device by a file.
void require_replaceable(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw system_error(path.string(), "cannot be written", EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(fmt::format("{}: is a device or a pipe, where a file is to be written", path.string()));
  }
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  require_replaceable(path_);
  file_ = FileDescriptor(::open(part_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!file_.is_open()) throw system_error(path_.string(), "cannot be created", errno);
  part_exists_ = true;
}

OutputFile::~OutputFile() {
  file_.close();
  if (part_exists_) ::unlink(part_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (buffer_.size() + text.size() > kBufferBytes) flush();
  if (text.size() > kBufferBytes) {
    write_now(text);
  } else {
    buffer_ += text;
  }
}

void OutputFile::write(std::span<const std::byte> bytes) { write(as_text(bytes)); }

void OutputFile::write_at(std::uint64_t position, std::span<const std::byte> bytes) {
  flush();
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw system_error(path_.string(), "cannot be written", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    position += static_cast<std::uint64_t>(written);
  }
}

std::size_t OutputFile::read_at(std::uint64_t position, std::span<std::byte> target) {
  flush();
  std::size_t done = 0;
  while (done < target.size()) {
    const ssize_t size =
        ::pread(file_.get(), target.data() + done, target.size() - done, static_cast<off_t>(position + done));
    if (size == 0) break;
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) throw system_error(path_.string(), "cannot be read back", errno);
    done += static_cast<std::size_t>(size);
  }
  return done;
}

void OutputFile::resize(std::uint64_t bytes) {
  flush();
  if (::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0) {
    throw system_error(path_.string(), "cannot be written", errno);
  }
}

void OutputFile::commit() {
  flush();
  if (const int error = file_.close()) throw system_error(path_.string(), "cannot be written", error);
  if (std::rename(part_.c_str(), path_.c_str()) != 0) {
    throw system_error(path_.string(), "cannot be put in place", errno);
  }
  part_exists_ = false;
}

void OutputFile::write_now(std::string_view bytes) {
  if (const int error = write_fully(file_.get(), bytes)) {
    throw system_error(path_.string(), "cannot be written", error);
  }
}

void OutputFile::flush() {
  write_now(buffer_);
  buffer_.clear();
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  write_file(path, as_text(bytes));
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

std::string read_text_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) throw system_error(path.string(), "cannot be read", errno);
  std::string text;
  std::array<char, kBufferBytes> chunk;
  while (true) {
    const ssize_t size = ::read(file.get(), chunk.data(), chunk.size());
    if (size == 0) return text;
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) throw system_error(path.string(), "cannot be read", errno);
    text.append(chunk.data(), static_cast<std::size_t>(size));
    if (text.size() > max_bytes) {
      throw Error(fmt::format("{}: is larger than {} bytes, too large for what it should be", path.string(),
                              max_bytes));
    }
  }
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

void remove_file(const std::filesystem::path& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) {
    throw system_error(path.string(), "cannot be removed", errno);
  }
}

}  // namespace esi

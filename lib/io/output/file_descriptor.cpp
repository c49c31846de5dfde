#include "esi/io/output/file_descriptor.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace esi {
namespace {

std::string_view advice(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return " (free some space and run again)";
    case EFBIG:
      return " (raise the limit on file sizes, ulimit -f)";
    case EMFILE:
      return " (raise the limit on open files, ulimit -n)";
    default:
      return "";
  }
}

/// Standard output may have been made non-blocking by another program that shares it.
void wait_until_writable(int file) {
  pollfd request{file, POLLOUT, 0};
  poll(&request, 1, -1);
}

}  // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

int FileDescriptor::close() {
  if (!is_open()) return 0;
  return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno;
}

int write_fully(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {
      wait_until_writable(file);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

Error system_error(const std::string& name, std::string_view action, int error_number) {
  return Error(fmt::format("{}: {}: {}{}", name, action, std::system_category().message(error_number),
                           advice(error_number)));
}

}  // namespace esi

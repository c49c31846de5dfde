#include "esi/io/output/lock_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "esi/io/output/output_file.hpp"

namespace esi {

LockFile::LockFile(std::filesystem::path path, const std::string& what) : path_(std::move(path)) {
  while (!open_and_lock(what)) {
  }
}

LockFile::~LockFile() {
  if (removes_at_end_ && file_.is_open()) ::unlink(path_.c_str());
}

void LockFile::replace_content(std::string_view text) {
  if (::ftruncate(file_.get(), 0) != 0 || ::lseek(file_.get(), 0, SEEK_SET) != 0) {
    throw system_error(path_.string(), "cannot be written", errno);
  }
  if (const int error = write_fully(file_.get(), text)) {
    throw system_error(path_.string(), "cannot be written", error);
  }
}

void LockFile::remove() {
  remove_file(path_);  // before the lock ends, so that nobody else's file is taken away
  file_.close();
}

/// False when the file was taken away between opening and locking: then the lock is on nothing.
bool LockFile::open_and_lock(const std::string& what) {
  constexpr int flags = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC;
  file_ = FileDescriptor(::open(path_.c_str(), flags | O_EXCL, 0666));
  removes_at_end_ = file_.is_open();
  if (!removes_at_end_ && errno == EEXIST) file_ = FileDescriptor(::open(path_.c_str(), flags, 0666));
  if (!file_.is_open()) throw system_error(path_.string(), "cannot be created", errno);
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    removes_at_end_ = false;
    if (error != EWOULDBLOCK) throw system_error(path_.string(), "cannot be locked", error);
    throw Error(fmt::format("{}: another run is writing it; wait for its end or choose another place", what));
  }
  struct stat opened {
  }, named{};
  return ::fstat(file_.get(), &opened) == 0 && ::stat(path_.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace esi

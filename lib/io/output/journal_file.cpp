#include "esi/io/output/journal_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <limits>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

std::vector<std::string> whole_lines(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return lines;
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
}

std::string whole_text(const std::filesystem::path& path) {
  return read_text_file(path, std::numeric_limits<std::size_t>::max());
}

}  // namespace

JournalFile::JournalFile(std::filesystem::path path, const std::string& what) : path_(std::move(path)) {
  constexpr int flags = O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC;
  file_ = FileDescriptor(::open(path_.c_str(), flags, 0666));
  if (!file_.is_open()) throw system_error(path_.string(), "cannot be opened", errno);
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    if (error != EWOULDBLOCK) throw system_error(path_.string(), "cannot be locked", error);
    throw Error(fmt::format("{}: another run is writing it; wait for its end or choose another place", what));
  }
  read_lines();
}

void JournalFile::read_lines() {
  const std::string text = whole_text(path_);
  lines_ = whole_lines(text);
  const std::size_t last_end = text.rfind('\n');
  const std::size_t whole = last_end == std::string::npos ? 0 : last_end + 1;
  if (whole == text.size()) return;
  if (::ftruncate(file_.get(), static_cast<off_t>(whole)) != 0) {
    throw system_error(path_.string(), "a torn last line cannot be cut off", errno);
  }
}

void JournalFile::append(std::string_view lines) {
  if (!file_.is_open()) throw Error(path_.string() + ": takes no more lines after one that failed");
  int error = write_fully(file_.get(), std::string(lines) + "\n");
  if (error == 0 && ::fsync(file_.get()) != 0) error = errno;
  if (error == 0) return;
  file_.close();
  throw system_error(path_.string(), "cannot be written", error);
}

std::vector<std::string> read_journal(const std::filesystem::path& path) {
  return whole_lines(whole_text(path));
}

}  // namespace esi

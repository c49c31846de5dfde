#include "esi/io/byte_source.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <thread>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {
namespace {

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string read(ByteSource& source, std::size_t bytes) {
  std::string text(bytes, '?');
  text.resize(source.read(std::as_writable_bytes(std::span(text))));
  return text;
}

std::string read_some(ByteSource& source, std::size_t bytes) {
  std::string text(bytes, '?');
  text.resize(source.read_some(std::as_writable_bytes(std::span(text))));
  return text;
}

std::string message_of(const std::filesystem::path& path) {
  try {
    const ByteSource source(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Puts another file in the place of standard input as long as it lives; -1 closes it.
class StandardInput {
 public:
  explicit StandardInput(int file) : saved_(dup(STDIN_FILENO)) {
    if (file < 0) {
      close(STDIN_FILENO);
    } else {
      dup2(file, STDIN_FILENO);
      close(file);
    }
  }
  ~StandardInput() {
    dup2(saved_, STDIN_FILENO);
    close(saved_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  int saved_;
};

}  // namespace

TEST_CASE("Bytes come in order, and what was looked at comes again") {
  const TempFolder folder;
  const auto path = folder.write("file", "abcdefghij");
  ByteSource source(path);
  CHECK(source.name() == path.string());
  CHECK(source.path() == path);
  CHECK_FALSE(source.is_stdin());
  CHECK(text_of(source.peek(3)) == "abc");
  CHECK(text_of(source.peek(5)) == "abcde");
  CHECK(text_of(source.peek(2)) == "ab");
  CHECK(source.position() == 0);
  CHECK(read(source, 2) == "ab");
  CHECK(source.position() == 2);
  CHECK(text_of(source.peek(4)) == "cdef");
  CHECK(source.skip(1) == 1);
  CHECK(read(source, 4) == "defg");
  CHECK(source.position() == 7);
  CHECK(text_of(source.peek(100)) == "hij");
  CHECK(source.skip(2) == 2);
  CHECK(read(source, 100) == "j");
  CHECK(source.position() == 10);
  CHECK(read(source, 100).empty());
  CHECK(source.skip(5) == 0);
  CHECK(source.peek(5).empty());
  CHECK(read_some(source, 5).empty());
}

TEST_CASE("Passing over many bytes ends at the end of the file") {
  const TempFolder folder;
  ByteSource source(folder.write("file", std::string(300000, 'x') + "yz"));
  CHECK(source.skip(300000) == 300000);
  CHECK(read(source, 1) == "y");
  CHECK(source.skip(1000000) == 1);
  CHECK(source.position() == 300002);
}

TEST_CASE("An empty file is empty, which is no error here") {
  const TempFolder folder;
  ByteSource source(folder.write("file", ""));
  CHECK(source.peek(10).empty());
  CHECK(read(source, 10).empty());
}

TEST_CASE("What cannot be read is refused with the reason and what to do") {
  const TempFolder folder;
  const auto file = folder.write("file", "x");
  CHECK_THAT(message_of(folder / "none"), Catch::EndsWith("/none: there is no such file; check the path"));
  CHECK_THAT(message_of(folder.path()), Catch::EndsWith(": it is a directory; give a file"));
  CHECK_THAT(message_of("/dev/zero"),
             Catch::Equals("/dev/zero: it is a device or a socket; give a file or a pipe"));
  CHECK_THAT(message_of(file / "below"), Catch::Contains("cannot be opened (Not a directory)"));
  CHECK_THAT(message_of(""), Catch::Contains("the path is empty"));
  if (geteuid() == 0) return;  // root may read everything
  REQUIRE(chmod(file.c_str(), 0) == 0);
  CHECK_THAT(message_of(file),
             Catch::EndsWith("/file: it cannot be opened (Permission denied); check its permissions"));
}

TEST_CASE("A file called - is reached by its path") {
  const TempFolder folder;
  ByteSource source(folder.write("-", "x"));
  CHECK_FALSE(source.is_stdin());
  CHECK(read(source, 9) == "x");
}

TEST_CASE("Standard input may be a pipe, which gives what it has") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const StandardInput input(ends[0]);
  ByteSource source("-");
  CHECK(source.is_stdin());
  CHECK(source.name() == "standard input");
  CHECK(source.path().empty());
  REQUIRE(write(ends[1], "abcdef", 6) == 6);
  CHECK(text_of(source.peek(2)) == "ab");
  CHECK(read_some(source, 100) == "ab");
  CHECK(read_some(source, 100) == "cdef");
  REQUIRE(write(ends[1], "ghi", 3) == 3);
  close(ends[1]);
  CHECK(read(source, 100) == "ghi");
  CHECK(source.position() == 9);
}

TEST_CASE("Standard input that somebody has set to non-blocking is waited for") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  REQUIRE(fcntl(ends[0], F_SETFL, O_NONBLOCK) == 0);
  const StandardInput input(ends[0]);
  ByteSource source("-");
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(write(ends[1], "abc", 3) == 3);
    close(ends[1]);
  });
  const std::string text = read(source, 100);
  writer.join();
  CHECK(text == "abc");
}

TEST_CASE("Standard input stays open for others") {
  const TempFolder folder;
  const StandardInput input(open(folder.write("file", "abc").c_str(), O_RDONLY));
  {
    ByteSource source("-");
    CHECK(read(source, 1) == "a");
  }
  ByteSource source("-");
  CHECK(read(source, 9) == "bc");
}

TEST_CASE("Standard input that cannot hold a recording is refused with the reason") {
  {
    const StandardInput input(-1);
    CHECK_THAT(message_of("-"),
               Catch::Equals("standard input: it is closed; give a file, or pipe a recording in"));
  }
  {
    const StandardInput input(open("/", O_RDONLY | O_DIRECTORY));
    CHECK_THAT(message_of("-"), Catch::Contains("it is a directory"));
  }
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  REQUIRE(terminal >= 0);
  REQUIRE(grantpt(terminal) == 0);
  REQUIRE(unlockpt(terminal) == 0);
  const int slave = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  REQUIRE(slave >= 0);
  {
    const StandardInput input(slave);
    CHECK_THAT(message_of("-"),
               Catch::Equals("standard input: it is a terminal; give a file, or pipe a recording in"));
  }
  close(terminal);
}

TEST_CASE("A signal that interrupts reading loses nothing") {
  struct sigaction action {};
  struct sigaction before {};
  static std::atomic<int> signals = 0;
  signals = 0;
  action.sa_handler = [](int) { ++signals; };  // without SA_RESTART, so that read(2) returns early
  REQUIRE(sigaction(SIGUSR1, &action, &before) == 0);

  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const StandardInput input(ends[0]);
  ByteSource source("-");
  const pthread_t reader = pthread_self();
  std::thread writer([&] {
    for (int i = 0; i < 3; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      pthread_kill(reader, SIGUSR1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(write(ends[1], "abc", 3) == 3);
    close(ends[1]);
  });
  const std::string text = read(source, 100);
  writer.join();
  sigaction(SIGUSR1, &before, nullptr);
  CHECK(text == "abc");
  CHECK(signals == 3);
}

TEST_CASE("A disk that fails while it is read is an error with the position") {
  const TempFolder folder;
  const auto path = folder.write("file", "abc");
  const StandardInput input(open(path.c_str(), O_WRONLY));  // reading it fails with EBADF
  ByteSource source("-");
  std::array<std::byte, 10> target;
  CHECK_THROWS_WITH(
      source.read(target),
      "standard input: reading failed at byte 0 (Bad file descriptor); check the disk or the pipe");
}

}  // namespace esi::test

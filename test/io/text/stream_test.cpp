// Texts that come through a pipe, trickle, or have lines without end.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <thread>

#include "io/text/read_text.hpp"

namespace esi::test {
namespace {

// A named pipe that another thread fills.
class Pipe {
 public:
  explicit Pipe(std::function<void(int)> fill) : path_(folder_ / "pipe.txt") {
    REQUIRE(mkfifo(path_.c_str(), 0600) == 0);
    writer_ = std::thread([this, fill = std::move(fill)] {
      const int file = open(path_.c_str(), O_WRONLY);
      fill(file);
      close(file);
    });
  }
  ~Pipe() { writer_.join(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  TempFolder folder_;
  std::filesystem::path path_;
  std::thread writer_;
};

void write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(file, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

std::string lines_from(int first, int count) {
  std::string text;
  for (int i = first; i < first + count; ++i)
    text += fmt::format("{}.{:03} 1 2 {}\n", i / 1000, i % 1000, i % 2);
  return text;
}

long peak_memory_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

TEST_CASE("A text that comes one byte at a time is read like any other") {
  const std::string text = lines_from(0, 3000);
  const Pipe pipe([&text](int file) {
    for (const char& c : text) write_all(file, {&c, 1});
  });
  CHECK(read_text_path(pipe.path()).events == read_text(text).events);
}

TEST_CASE("Events of lines that are there are given without waiting for more") {
  std::atomic<int> events_seen = 0;
  std::atomic<bool> waited_in_vain = false;
  const auto wait_for = [&](int events) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (events_seen < events && !waited_in_vain) {
      if (std::chrono::steady_clock::now() > deadline) waited_in_vain = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  const Pipe pipe([&](int file) {
    write_all(file, lines_from(0, 400));  // more than the bytes that the format is told by
    wait_for(400);
    write_all(file, lines_from(400, 1) + "0.401 1");
    wait_for(401);
    write_all(file, " 2 1\n" + lines_from(402, 2));
    wait_for(404);
  });

  const auto reader = open_text(std::make_unique<ByteSource>(pipe.path()), {});
  Packet packet;
  Losses losses;
  while (reader->read(packet, losses)) events_seen = static_cast<int>(packet.events.size());
  CHECK_FALSE(waited_in_vain);
  CHECK(packet.events.size() == 404);
  CHECK(losses.text().empty());
}

TEST_CASE("A line of hundreds of megabytes costs no memory and is left out") {
  constexpr int kMegabytes = 200;
  const bool is_comment = GENERATE(false, true);
  const long before_kib = peak_memory_kib();
  const Pipe pipe([&](int file) {
    write_all(file, lines_from(0, 1500));
    if (is_comment) write_all(file, "#");
    const std::string megabyte(std::size_t{1} << 20, '1');
    for (int i = 0; i < kMegabytes; ++i) write_all(file, megabyte);
    write_all(file, "\n" + lines_from(1500, 3));
  });
  const TextContent content = read_text_path(pipe.path());
  CHECK(content.events.size() == 1503);
  CHECK(content.events.back().t_us == 1502000);
  CHECK(content.losses.of(Drop::unreadable_line) == (is_comment ? 0 : 1));
  CHECK(peak_memory_kib() - before_kib < 16 * 1024);
}

TEST_CASE("A line is whole at every place where a buffer may end within it") {
  // 256 KiB is the reader's buffer: lines of 22 characters meet its end at every offset as the shift grows.
  const int shift = GENERATE(range(0, 23));
  std::string text = "#" + std::string(static_cast<std::size_t>(shift), '-') + "\n";
  for (int i = 0; i < 30000; ++i)
    text +=
        fmt::format("{}.{:06} {:03} {:03} {}\n", 10 + i / 100000, i * 10 % 1000000, i % 346, i % 260, i % 2);
  const TextContent content = read_text(text);
  REQUIRE(content.events.size() == 30000);
  bool all_right = true;
  for (int i = 0; i < 30000; ++i) {
    const Event& event = content.events[static_cast<std::size_t>(i)];
    all_right = all_right && event == Event{10000000 + i * 10, static_cast<std::uint16_t>(i % 346),
                                            static_cast<std::uint16_t>(i % 260), i % 2 == 1};
  }
  CHECK(all_right);
}

TEST_CASE("A line that just fits the buffer is read, and a longer one is not taken for another number") {
  for (const int extra : {-3, -2, -1, 0, 1, 2, 3, 5000}) {
    // "1.5 1 2 <many blanks> 1": legal at any length that fits.
    const std::string blanks(static_cast<std::size_t>(256 * 1024 - 10 + extra), ' ');
    const TextContent content = read_text(lines_from(0, 1400) + "1.5 1 2" + blanks + "1\n2.0 1 2 1\n");
    INFO(extra);
    CHECK(content.events.size() == (blanks.size() + 9 <= 256 * 1024 ? 1402 : 1401));
    CHECK(content.losses.of(Drop::unreadable_line) == (blanks.size() + 9 <= 256 * 1024 ? 0 : 1));
    CHECK(content.events.back().t_us == 2000000);
  }
}

}  // namespace esi::test

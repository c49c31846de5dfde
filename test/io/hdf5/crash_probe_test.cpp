// libhdf5 itself crashes on some damaged files: a child process dies in our place.
#include "esi/io/hdf5/crash_probe.hpp"

#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <thread>

#include "support/hdf5_recordings.hpp"
#include "support/random_events.hpp"
#include "support/read_hdf5.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

TEST_CASE("A crash of an attempt is told, its end is not") {
  CHECK_THAT(crash_of([] { raise(SIGSEGV); }).value(), Contains("signal 11"));
  CHECK_THAT(crash_of([] { abort(); }).value(), Contains("signal 6"));
  CHECK_THAT(crash_of([] { raise(SIGFPE); }).value(), Contains("signal 8"));
  CHECK_THAT(crash_of([] { raise(SIGKILL); }).value(), Contains("signal 9"));
  CHECK_THAT(crash_of([] { _exit(1); }).value(), Contains("exit 1"));
  CHECK_FALSE(crash_of([] {}));
  CHECK_FALSE(crash_of([] { throw Error("damaged"); }));
  CHECK_FALSE(crash_of([] { throw std::bad_alloc(); }));
  CHECK_FALSE(crash_of([] { raise(SIGINT); }));
  CHECK_FALSE(crash_of([] { raise(SIGTERM); }));
}

TEST_CASE("An attempt that never ends is a crash, one that only waits is not") {
  volatile bool is_done = false;
  const auto endless = [&] {
    while (!is_done) {
    }
  };
  CHECK_THAT(crash_of(endless, {.cpu_s = 1, .wall_s = 60}).value(), Contains("CPU"));
  const auto begin = std::chrono::steady_clock::now();
  CHECK_FALSE(crash_of([] { sleep(60); }, {.cpu_s = 5, .wall_s = 1}));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(15));
}

std::atomic<int> handled = 0;

TEST_CASE("An attempt dies of signals that the program handles or blocks, and changes nothing in it") {
  struct sigaction before {};
  struct sigaction counting {};
  counting.sa_handler = [](int /*signal*/) { ++handled; };
  sigaction(SIGSEGV, &counting, &before);
  sigset_t blocked, old;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGSEGV);
  sigprocmask(SIG_BLOCK, &blocked, &old);
  int value = 1;
  const auto crash = crash_of([&] {
    value = 2;
    raise(SIGSEGV);
  });
  sigprocmask(SIG_SETMASK, &old, nullptr);
  sigaction(SIGSEGV, &before, nullptr);
  CHECK_THAT(crash.value(), Contains("signal 11"));
  CHECK(handled == 0);
  CHECK(value == 1);
}

TEST_CASE("Files on which libhdf5 1.10.8 crashes are an error") {
  for (const char* const name : {"floating_point_exception.h5", "segmentation_fault.h5", "endless_loop.h5"}) {
    INFO(name);
    const std::string message = hdf5_error(source_dir() / "test/fuzz/crashes/hdf5" / name);
    CHECK_THAT(message, Contains(std::string(name) + ": "));
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
    if (major == 1 && minor == 10 && release == 8)
      CHECK_THAT(message, Contains("libhdf5 crashes on it") && Contains("copy it again"));
  }
}

TEST_CASE("HDF5 files are opened by several threads, each with a child process") {
  const TempFolder folder;
  const std::vector<Event> events = random_events({0, 0, 240, 180}, 1000, 5, 1);
  folder.write("a.h5", metavision_hdf5_recording(events));
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k) right += read_hdf5(folder / "a.h5").events == events ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(right == 20);
}

}  // namespace

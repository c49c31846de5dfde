#include "esi/io/hdf5/crash_probe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>

#include "esi/io/hdf5/handle.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define ESI_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ESI_ADDRESS_SANITIZER
#endif
#endif

namespace esi {
namespace {

/// What a crash ends with. SIGKILL is how the kernel ends a process that takes all memory.
constexpr std::array kCrashSignals = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL,
                                      SIGTRAP, SIGSYS, SIGXCPU, SIGKILL};

bool is_crash(int signal) {
  return std::find(kCrashSignals.begin(), kCrashSignals.end(), signal) != kCrashSignals.end();
}

void set_limits(const CrashProbeLimits& limits) {
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  // At the second one comes SIGKILL.
  const rlimit cpu_s = {limits.cpu_s, limits.cpu_s + 1};
  setrlimit(RLIMIT_CPU, &cpu_s);
  alarm(limits.wall_s);
}

/// Sanitizers and tools have handlers of their own for some of these signals.
void let_signals_kill() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGXCPU, SIGALRM,
                           SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_UNBLOCK, &all, nullptr);
}

void be_silent() {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

[[noreturn]] void try_in_child(const std::function<void()>& attempt, const CrashProbeLimits& limits) {
  let_signals_kill();
  set_limits(limits);
  be_silent();
  try {
    attempt();
  } catch (const std::exception&) {
    _exit(0);  // The parent meets it again, and tells it.
  }
  _exit(0);
}

/// glibc's allocator is whole in a child, whatever other threads were doing. AddressSanitizer's (gcc 12,
/// clang 14) may be locked there for ever: the child would wait, or turn in place and look like a crash.
bool can_child_allocate() {
#ifdef ESI_ADDRESS_SANITIZER
  std::error_code unreadable;
  const std::filesystem::directory_iterator threads("/proc/self/task", unreadable);
  return std::distance(begin(threads), end(threads)) == 1;
#else
  return true;
#endif
}

}  // namespace

std::optional<std::string> crash_of(const std::function<void()>& attempt, const CrashProbeLimits& limits) {
  const Hdf5Lock lock;
  if (!can_child_allocate()) return std::nullopt;
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) try_in_child(attempt, limits);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return std::nullopt;
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) != 0) return fmt::format("exit {}", WEXITSTATUS(status));
  if (!WIFSIGNALED(status) || !is_crash(WTERMSIG(status))) return std::nullopt;
  const int signal = WTERMSIG(status);
  return fmt::format("signal {} ({})", signal, strsignal(signal));
}

}  // namespace esi

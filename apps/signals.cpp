#include "signals.hpp"

#include <csignal>

#include <atomic>

#include "cli.hpp"

namespace esi::cli {
namespace {

std::atomic<int> caught_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void remember(int signal) { caught_signal = signal; }

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

int stop_signal() { return caught_signal; }

int stop_exit_code() { return caught_signal == SIGTERM ? kTerminated : kInterrupted; }

}  // namespace esi::cli

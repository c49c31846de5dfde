#include "mpi_team.hpp"

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "cli.hpp"

// Every wait sleeps between its looks: MPI's own would spin and take a core from the work.
namespace esi::cli {
namespace {

constexpr int kQuestion = 1, kReply = 2;  // tags; an empty question says goodbye
constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::microseconds kShortestSleep{50}, kLongestSleep{5000};

/// Longer from look to look.
class Patience {
 public:
  void sleep() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(2 * pause_, kLongestSleep);
  }

 private:
  std::chrono::microseconds pause_ = kShortestSleep;
};

void wait_for(MPI_Request request) {
  Patience patience;
  for (;;) {
    int is_done = 0;
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done != 0) return;
    patience.sleep();
  }
}

void send(const std::string& text, int to, int tag) {
  MPI_Request request{};
  MPI_Isend(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD, &request);
  wait_for(request);
}

/// The message that MPI_Iprobe has seen.
std::string receive(MPI_Status status) {
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

/// What each process gave, by rank.
template <std::size_t N>
std::vector<std::array<int, N>> all_of(const std::array<int, N>& own, int processes) {
  constexpr int count = static_cast<int>(N);
  std::vector<std::array<int, N>> all(static_cast<std::size_t>(processes));
  MPI_Request request{};
  MPI_Iallgather(own.data(), count, MPI_INT, all.data(), count, MPI_INT, MPI_COMM_WORLD, &request);
  wait_for(request);
  return all;
}

}  // namespace

MpiTeam::MpiTeam(int& argc, char**& argv) {
  int level = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &processes_);
  if (level < MPI_THREAD_SERIALIZED) {
    if (is_leader()) say("esi-sweep", "this MPI has no MPI_THREAD_SERIALIZED; use another");
    MPI_Abort(MPI_COMM_WORLD, kFailed);
  }
  if (processes_ == 1) return;
  hold_messages();
  if (!is_leader() && std::freopen("/dev/null", "w", stdout) == nullptr) MPI_Abort(MPI_COMM_WORLD, kFailed);
}

MpiTeam::~MpiTeam() { MPI_Finalize(); }

int MpiTeam::threads() const {
  MPI_Comm machine{};
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  int neighbours = 1;
  MPI_Comm_size(machine, &neighbours);
  // mpirun may have bound each process to cores of its own, or none.
  cpu_set_t own, together;
  CPU_ZERO(&own);
  CPU_ZERO(&together);
  sched_getaffinity(0, sizeof own, &own);
  MPI_Allreduce(&own, &together, static_cast<int>(sizeof own), MPI_BYTE, MPI_BOR, machine);
  MPI_Comm_free(&machine);
  return std::max(1, CPU_COUNT(&together) / neighbours);
}

bool MpiTeam::begin() {
  has_met_ = true;
  const auto ready = all_of<1>({1}, processes_);
  has_begun_ = std::all_of(ready.begin(), ready.end(), [](const auto& process) { return process[0] == 1; });
  return has_begun_;
}

bool MpiTeam::answer_one(const Answer& answer) {
  int is_there = 0;
  MPI_Status status{};
  MPI_Iprobe(MPI_ANY_SOURCE, kQuestion, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return false;
  const std::string question = receive(status);
  if (question.empty()) {
    ++left_;
  } else {
    send(answer(question), status.MPI_SOURCE, kReply);
  }
  return true;
}

void MpiTeam::serve(const Answer& answer, const std::function<void()>& tick) {
  auto next_tick = std::chrono::steady_clock::now();
  Patience patience;
  while (left_ < processes_ - 1) {
    if (const auto now = std::chrono::steady_clock::now(); now >= next_tick) {
      tick();
      next_tick = now + kTick;
    }
    if (answer_one(answer)) {
      patience = {};
    } else {
      patience.sleep();
    }
  }
}

std::string MpiTeam::ask(const std::string& question) {
  const std::lock_guard lock(mutex_);
  send(question, 0, kQuestion);
  Patience patience;
  for (;;) {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(0, kReply, MPI_COMM_WORLD, &is_there, &status);
    if (is_there != 0) return receive(status);
    patience.sleep();
  }
}

int MpiTeam::end(int exit_code) {
  if (!has_met_) all_of<1>({0}, processes_);
  if (has_begun_ && !is_leader()) send("", 0, kQuestion);
  const std::string said = held_messages();
  const auto outcomes = all_of<2>({exit_code, said.empty() ? 0 : 1}, processes_);
  const auto speaker =
      std::find_if(outcomes.begin(), outcomes.end(), [](const auto& o) { return o[1] == 1; });
  if (speaker - outcomes.begin() == rank_) std::fputs(said.c_str(), stderr);
  int worst = kDone;
  for (const auto& outcome : outcomes) worst = worst_of(worst, outcome[0]);
  return worst;
}

}  // namespace esi::cli

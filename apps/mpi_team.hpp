#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "esi/sweep/sweep_team.hpp"

namespace esi::cli {

/// The processes that mpirun or srun has started; rank 0 leads. Made once, in main(), before anything is
/// printed: with several processes only the leader has a stdout, and say() keeps its lines for end().
class MpiTeam final : public SweepTeam {
 public:
  MpiTeam(int& argc, char**& argv);
  ~MpiTeam() override;
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  bool is_leader() const override { return rank_ == 0; }
  int processes() const override { return processes_; }
  bool begin() override;
  void serve(const Answer& answer, const std::function<void()>& tick) override;
  std::string ask(const std::string& question) override;

  /// This process' share of the cores that the processes on its machine may use, at least 1.
  int threads() const;

  /// Waits for the others. The first process that has anything to say says it; all return the worst exit
  /// code.
  int end(int exit_code);

 private:
  bool answer_one(const Answer& answer);

  int rank_ = 0, processes_ = 1;
  int left_ = 0;  ///< of the leader: how many of the others have left
  bool has_met_ = false, has_begun_ = false;
  std::mutex mutex_;  ///< of ask()
};

}  // namespace esi::cli

#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "esi/core/options.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace esi::cli {

/// Exit codes of every tool (contract.md).
enum ExitCode {
  kDone = 0,
  kFailed = 1,
  kUsage = 2,
  kDoneWithLosses = 3,
  kRequirementMissed = 4,
  kInterrupted = 130,
  kPipeClosed = 141,
  kTerminated = 143,
};

/// The exit code of two outcomes together: what was stopped outweighs what failed, and that what was lost.
int worst_of(int a, int b);

/// Runs a tool's body and turns exceptions into one line on stderr and an exit code. Nothing else catches.
int guarded(const std::string& tool, const std::function<int()>& body);

/// One line on stderr: "esi-recon: what happened".
void say(const std::string& tool, const std::string& what);
/// From here on say() keeps its lines for who asks for them: a process of several that say the same.
void hold_messages();
std::string held_messages();
/// The line and the exit code for an exception.
int report(const std::string& tool, const std::exception& error);

/// What was given for --threads or the like. Throws a usage Error unless it is 1 to 1024.
int checked_threads(const char* flag, std::int64_t given);

/// Command-line flags made from option tables: time_zero becomes --time-zero, duration_s --duration.
class TableFlags {
 public:
  /// The table's struct must outlive this.
  void add(CLI::App& app, OptionTable table, const std::string& group);
  /// Sets what was given on the command line. Call after parsing, when a config has been taken.
  void apply();

 private:
  struct Flag {
    Option option;
    CLI::Option* flag;
    std::string text;
    bool state;
  };
  std::list<Flag> flags_;  // CLI11 keeps pointers to text and state
};

/// The flags of tools that do one job.
struct RunningFlags {
  RunningFlags();
  void add(CLI::App& app);

  std::int64_t threads;  ///< as given; checked_threads() judges it
  bool quiet = false;
  bool print_config = false;
  static constexpr const char* kGroup = "Running";  ///< in --help
};

/// Parses; prints --help and --version. Returns true when the tool should go on, else `exit_code` holds 0
/// or 2.
bool parse(CLI::App& app, int argc, const char* const* argv, int& exit_code);

}  // namespace esi::cli

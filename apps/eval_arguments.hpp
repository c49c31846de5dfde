#pragma once

#include <string>

#include "cli.hpp"

#include "esi/pipeline/eval_job.hpp"

namespace esi::cli {

/// What the command line of esi-eval says.
struct EvalArguments {
  EvalJob job;
  EvalConfig config;
  RunningFlags running;
};

/// Fills `arguments`. Returns true when the tool should go on, else `exit_code` holds 0 or 2.
/// Throws a usage Error on values that can't be.
bool parse_eval_arguments(int argc, const char* const* argv, EvalArguments& arguments, int& exit_code);

}  // namespace esi::cli

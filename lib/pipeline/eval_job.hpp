#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "esi/pipeline/evaluation/evaluate.hpp"
#include "esi/pipeline/evaluation/requirement.hpp"

namespace esi {

struct EvalJob {
  std::vector<EvalInput> inputs;
  std::filesystem::path output;
  int threads = 1;
  bool force = false;
  std::vector<Requirement> requirements;
  std::string tool;  ///< "esi-eval", for report.json
};

struct EvalReport {
  bool stopped = false;
  bool has_losses = false;
  std::string losses;               ///< in words
  std::vector<std::string> missed;  ///< requirements, a sentence each
  std::string summary;              ///< the tables of rates, for people
};

/// Evaluates, and fills a folder: report.json, table.csv, table.md, table.tex, tags.csv, frames.csv,
/// detections.csv, cost.csv, track_*.tum and truth_*.tum, report.html, and at last run.json, the mark that it
/// is complete. The folder is not touched before all is evaluated.
/// The same input and options give the same bytes but for cost.csv, report.html's figure of costs and the
/// blocks `run`. Throws as evaluate() does, and Errors of files that can't be written.
EvalReport run_job(const EvalJob& job, const EvalConfig& config, const Observer& observer);

}  // namespace esi

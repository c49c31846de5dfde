#pragma once

#include <vector>

#include "esi/pipeline/evaluation/results.hpp"
#include "esi/report/table.hpp"

namespace esi {

/// For people: a row a method, a column a phase with "detected/frames (rate)"; then what is false, the corner
/// error and the rate of tags.
Table rate_table(const InputResult& result);

/// For programs (table.csv): a row for each input, method and phase, `total` last; every number of the score.
/// A rate that there isn't is empty, with its reason.
Table score_rows(const std::vector<InputResult>& results);

/// The same for each tag id (tags.csv).
Table tag_rows(const std::vector<InputResult>& results);

/// Every decoded tag: frame,t_us,family,id,hamming,margin,cx,cy,x1,y1,...,x4,y4,input,method.
Table detection_rows(const Evaluation& evaluation, const std::string& family);

/// Every frame: input,method,frame,t_us,phase,detected. A frame in no phase has an empty phase.
Table frame_rows(const Evaluation& evaluation, const std::vector<InputResult>& results);

/// Quality and tracking, for people; without rows where there is nothing to tell.
Table quality_table(const InputResult& result);
Table tracking_table(const InputResult& result);

}  // namespace esi

#include "esi/eval/phase_tally.hpp"

#include <algorithm>
#include <utility>

namespace esi {

void TagTally::add_chance(bool is_found) {
  ++instances_.of;
  if (is_found) ++instances_.hits;
}

void TagTally::add_hit(const TagHit& hit, bool truth_has_corners) {
  if (hit.corner_error_px) errors_px_.push_back(*hit.corner_error_px);
  if (!hit.corner_error_px && truth_has_corners) ++unverified_;
  margins_.push_back(hit.detection.margin);
  const auto bits = static_cast<std::size_t>(std::max(0, hit.detection.hamming));
  if (hamming_.size() <= bits) hamming_.resize(bits + 1);
  ++hamming_[bits];
}

void TagTally::add_time(std::int64_t t_us) {
  longest_gap_us_ = std::max(longest_gap_us_, t_us - latest_us_);
  latest_us_ = t_us;
  if (!first_us_) first_us_ = t_us;
}

TagScore TagTally::score(std::int64_t duration_us) const {
  TagScore score;
  score.instances = instances_;
  score.corner_error_median_px = median(errors_px_);
  score.corner_error_mean_px = mean(errors_px_);
  score.corner_error_p95_px = quantile(errors_px_, 0.95);
  score.margin_median = median(margins_);
  score.hamming = hamming_;
  score.unverified = unverified_;
  score.first_found_us = first_us_;
  score.longest_gap_us = std::max(longest_gap_us_, duration_us - latest_us_);
  return score;
}

PhaseTally::PhaseTally(const std::vector<int>& expected_ids) {
  for (const int id : expected_ids) by_id_[id];
}

void PhaseTally::add(std::int64_t t_us, const FrameVerdict& verdict, const std::vector<TagChance>& chances,
                     bool truth_has_corners) {
  times_us_.push_back(t_us);
  is_detected_.push_back(verdict.hits.empty() ? 0.0 : 1.0);
  wrong_ += verdict.wrong;
  if (!verdict.hits.empty()) tags_.add_time(t_us);
  for (const TagHit& hit : verdict.hits) {
    TagTally& tag = by_id_[hit.detection.id];
    tag.add_time(t_us);
    tag.add_hit(hit, truth_has_corners);
    tags_.add_hit(hit, truth_has_corners);
  }
  for (const TagChance& chance : chances) {
    by_id_[chance.id].add_chance(chance.is_found);
    tags_.add_chance(chance.is_found);
  }
}

PhaseScore PhaseTally::score(std::string name, std::int64_t duration_us,
                             const BootstrapOptions& options) const {
  PhaseScore score;
  score.name = std::move(name);
  score.duration_us = duration_us;
  score.frames.of = static_cast<std::int64_t>(times_us_.size());
  score.frames.hits = std::count(is_detected_.begin(), is_detected_.end(), 1.0);
  if (times_us_.empty()) score.reason = "no frame lies in this phase";
  score.bootstrap = bootstrap_mean(is_detected_, times_us_, options);
  score.wrong = wrong_;
  score.tags = tags_.score(duration_us);
  for (const auto& [id, tag] : by_id_) score.by_id[id] = tag.score(duration_us);
  return score;
}

}  // namespace esi

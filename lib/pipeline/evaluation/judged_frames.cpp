#include "esi/pipeline/evaluation/judged_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "esi/core/cpu_time.hpp"
#include "esi/core/error.hpp"
#include "esi/io/picture_list.hpp"

namespace esi {
namespace {

/// A clean frame counts as of the same time within this.
constexpr std::int64_t kSameTime_us = 500;

std::optional<std::size_t> phase_of(const std::vector<Phase>& phases, std::int64_t t_us) {
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (phases[i].interval.contains(t_us)) return i;
  }
  return std::nullopt;
}

std::int64_t from_middle_us(const Phase& phase, std::int64_t t_us) {
  return std::abs(t_us - (phase.interval.begin_us + phase.interval.duration_us() / 2));
}

ImageQuality quality_of(const cv::Mat1b& grey, const std::filesystem::path& clean) {
  const cv::Mat1b reference = read_picture(clean);
  if (reference.size() == grey.size()) return compare_images(grey, reference);
  throw usage_error(fmt::format("{}: the clean frame is {}x{} px large, the frames are {}x{}; --no-quality",
                                clean.string(), reference.cols, reference.rows, grey.cols, grey.rows));
}

}  // namespace

TagDetector DetectorPool::take() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) return TagDetector(options_);
  TagDetector detector = std::move(idle_.back());
  idle_.pop_back();
  return detector;
}

void DetectorPool::put_back(TagDetector detector) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(detector));
}

JudgedFrames::JudgedFrames(const EvalConfig& config, const LoadedTruth& truth, WorkerPool& pool,
                           DetectorPool& detectors, std::size_t at_once)
    : config_(config), truth_(truth), pool_(pool), detectors_(detectors), at_once_(at_once) {}

/// Tasks that still run refer to this.
JudgedFrames::~JudgedFrames() { stop(); }

void JudgedFrames::write(const Frame& frame) {
  if (frame.index % config_.judging.stride != config_.judging.first_frame) return;
  while (pending_.size() >= at_once_) collect();
  Pending& pending = pending_.emplace_back();
  pending.grey = frame.grey.clone();
  pending.found.index = frame.index;
  pending.found.t_us = frame.t_us;
  pending.done = pool_.submit([this, &pending] { judge(pending); });
}

void JudgedFrames::finish(const std::string& /*manifest*/) {
  while (!pending_.empty()) collect();
}

void JudgedFrames::stop() {
  for (; !pending_.empty(); pending_.pop_front()) {
    try {
      if (pending_.front().done.valid()) pool_.finish(std::move(pending_.front().done));
    } catch (const std::exception&) {
      continue;  // what comes of a frame that nobody wants makes no difference
    }
  }
}

void JudgedFrames::judge(Pending& frame) {
  const double begin_s = thread_cpu_s();
  TagDetector detector = detectors_.take();
  frame.found.detections = detector.detect(frame.grey);
  detectors_.put_back(std::move(detector));
  frame.detection_ms = 1e3 * (thread_cpu_s() - begin_s);
  const std::filesystem::path* const clean = clean_frame_of(frame.found.t_us);
  if (clean == nullptr) return;
  frame.quality.t_us = frame.found.t_us;
  frame.quality.quality = quality_of(frame.grey, *clean);
  frame.quality.sharpness = sharpness(frame.grey);
}

void JudgedFrames::collect() {
  Pending& frame = pending_.front();
  pool_.finish(std::move(frame.done));
  run_.detection_ms.push_back(frame.detection_ms);
  if (frame.quality.quality) run_.quality.push_back(frame.quality);
  keep_sample(frame);
  run_.frames.push_back(std::move(frame.found));
  pending_.pop_front();
}

void JudgedFrames::keep_sample(Pending& frame) {
  const auto phase = phase_of(truth_.truth.phases, frame.found.t_us);
  if (!phase) return;
  const double limit_px = config_.score.max_corner_error_px;
  const bool is_detected =
      !esi::judge(frame.found, truth_.expected, truth_.corner_track(), limit_px).hits.empty();
  const auto is_alike = [&](const SampleFrame& sample) {
    return sample.phase == *phase && sample.is_detected == is_detected;
  };
  const auto kept = std::find_if(run_.samples.begin(), run_.samples.end(), is_alike);
  const Phase& whole = truth_.truth.phases[*phase];
  SampleFrame sample{*phase, is_detected, frame.found.t_us, frame.found.detections, frame.grey};
  if (kept == run_.samples.end()) {
    run_.samples.push_back(std::move(sample));
  } else if (from_middle_us(whole, sample.t_us) < from_middle_us(whole, kept->t_us)) {
    *kept = std::move(sample);
  }
}

const std::filesystem::path* JudgedFrames::clean_frame_of(std::int64_t t_us) const {
  const auto found = truth_.clean_frames.lower_bound(t_us - kSameTime_us);
  if (found == truth_.clean_frames.end() || found->first > t_us + kSameTime_us) return nullptr;
  return &found->second;
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "esi/core/worker_pool.hpp"
#include "esi/eval/detection.hpp"
#include "esi/eval/image_quality.hpp"
#include "esi/eval/tag_detector.hpp"
#include "esi/io/output/frame_sink.hpp"
#include "esi/pipeline/evaluation/loaded_truth.hpp"

namespace esi {

/// Detectors for tasks that run at the same time: each takes one and puts it back.
class DetectorPool {
 public:
  explicit DetectorPool(const DetectorOptions& options) : options_(options) {}

  TagDetector take();
  void put_back(TagDetector detector);

 private:
  DetectorOptions options_;
  std::mutex mutex_;
  std::vector<TagDetector> idle_;
};

/// A frame that is kept to be shown.
struct SampleFrame {
  std::size_t phase = 0;
  bool is_detected = false;
  std::int64_t t_us = 0;
  std::vector<Detection> detections;
  cv::Mat1b grey;
};

struct FrameQuality {
  std::int64_t t_us = 0;
  std::optional<ImageQuality> quality;  ///< where there is a clean frame of that time
  std::optional<double> sharpness;
};

/// What a method's frames are worth, one by one.
struct MethodRun {
  std::string label;
  std::vector<FrameDetections> frames;
  std::vector<double> detection_ms;       ///< processor time, frame by frame
  std::vector<double> reconstruction_ms;  ///< the same; empty for frames that were given as pictures
  std::vector<FrameQuality> quality;      ///< of frames that have a clean one beside them
  std::vector<SampleFrame> samples;  ///< of each phase one detected and one missed, nearest to its middle
};

/// Takes frames in order and has tags looked for in them, several frames at a time, few of them in memory.
class JudgedFrames final : public FrameSink {
 public:
  /// What is referred to must outlive this. `at_once` frames are in memory at most.
  JudgedFrames(const EvalConfig& config, const LoadedTruth& truth, WorkerPool& pool, DetectorPool& detectors,
               std::size_t at_once);
  ~JudgedFrames() override;

  void write(const Frame& frame) override;
  /// All frames are judged when this returns; there is no manifest.
  void finish(const std::string& manifest) override;
  void stop() override;

  MethodRun& run() { return run_; }

 private:
  struct Pending {
    cv::Mat1b grey;
    FrameDetections found;
    FrameQuality quality;
    double detection_ms = 0.0;
    std::future<void> done;
  };

  void judge(Pending& frame);
  void collect();
  void keep_sample(Pending& frame);
  const std::filesystem::path* clean_frame_of(std::int64_t t_us) const;

  const EvalConfig& config_;
  const LoadedTruth& truth_;
  WorkerPool& pool_;
  DetectorPool& detectors_;
  std::size_t at_once_;
  std::deque<Pending> pending_;
  MethodRun run_;
};

}  // namespace esi

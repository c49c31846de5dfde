#include "esi/pipeline/evaluation/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "esi/core/error.hpp"
#include "esi/io/picture_list.hpp"
#include "esi/pipeline/evaluation/timed_reconstructor.hpp"
#include "esi/pipeline/frame_loop.hpp"
#include "esi/pipeline/ready_method.hpp"

namespace esi {
namespace {

/// Frames of one method that are in memory, for each thread.
constexpr std::size_t kFramesPerThread = 3;

/// The pictures of a folder within the part that was asked for.
std::vector<ListedPicture> pictures_of(const EvalInput& input, Interval part) {
  auto pictures = list_frames(input.path);
  std::erase_if(pictures, [&](const ListedPicture& picture) { return !part.contains(picture.t_us); });
  if (!pictures.empty()) return pictures;
  throw Error(fmt::format("{}: there are no frames in the part that was asked for", input.path.string()));
}

/// Truth in the pixels of another camera would make everything a false detection.
void require_size_of_camera(const InputRun& input, SensorSize size) {
  const auto& camera = input.truth.truth.camera;
  if (!camera || (camera->width_px == size.width_px && camera->height_px == size.height_px)) return;
  throw usage_error(fmt::format("{}: it is {} px large, the camera of {} is {}; give the truth of this one",
                                input.input.path.string(), to_string(size), input.input.truth.string(),
                                to_string(SensorSize{camera->width_px, camera->height_px})));
}

/// One method's way through a recording.
struct Lane {
  Lane(const EvalConfig& config, const EvalMethod& method, const MethodContext& context,
       const LoadedTruth& truth, WorkerPool& pool, DetectorPool& detectors)
      : ready(method.config, context),
        timed(ready.reconstructor()),
        schedule(config.frames_of(method).make_schedule()),
        judged(config, truth, pool, detectors, kFramesPerThread * (pool.workers() + 1)),
        loop(*schedule, timed, judged, config.frames.max_frames, context.name) {
    judged.run().label = method.label;
  }

  MethodRun take_run() {
    judged.finish("");
    MethodRun run = std::move(judged.run());
    run.reconstruction_ms = std::move(timed.frame_ms());
    return run;
  }

  ReadyMethod ready;
  TimedReconstructor timed;
  std::unique_ptr<FrameSchedule> schedule;
  JudgedFrames judged;
  FrameLoop loop;
};

class Evaluator {
 public:
  Evaluator(const EvalConfig& config, int threads, const Observer& observer)
      : config_(config), observer_(observer), pool_(threads - 1), detectors_(config.detector) {}

  /// Of several inputs the one of that index. False when the observer stopped it.
  bool run(InputRun& input, std::size_t index) {
    index_ = index;
    return input.input.is_frames ? run_frames(input) : run_recording(input);
  }

 private:
  bool run_recording(InputRun& input) {
    const std::string name = input.input.path.string();
    const ReadOptions read = read_options(input);
    auto recording = open_recording(input.input.path, read);
    const auto sensor = recording->sensor_size();
    CropSource source(std::move(recording), config_.frames.interval(), config_.frames.region());
    input.size = require_sensor_size(source, name);
    require_size_of_camera(input, sensor.value_or(input.size));
    const MethodContext context{
        input.input.path, name, read, &source.header(), sensor.value_or(input.size), config_.frames.region()};
    std::vector<std::unique_ptr<Lane>> lanes;
    for (const EvalMethod& method : config_.methods) {
      lanes.push_back(std::make_unique<Lane>(config_, method, context, input.truth, pool_, detectors_));
    }
    if (!feed(lanes, source, input)) return false;
    refuse_nothing(input, source, name);
    for (const auto& lane : lanes) input.methods.push_back(lane->take_run());
    return true;
  }

  /// Where neither the options nor the file have the sensor's size, the truth's camera has it.
  ReadOptions read_options(const InputRun& input) const {
    ReadOptions read = config_.read;
    const auto& camera = input.truth.truth.camera;
    if (!camera || open_recording(input.input.path, read)->sensor_size()) return read;
    read.size = to_string(SensorSize{camera->width_px, camera->height_px});
    return read;
  }

  bool feed(std::vector<std::unique_ptr<Lane>>& lanes, CropSource& source, InputRun& input) {
    input.digest.emplace();
    Packet packet;
    while (source.next(packet)) {
      input.digest->add(packet.events);
      for (const auto& lane : lanes) lane->loop.take(packet);
      if (observer_ && !observer_(progress(lanes, source, input))) return false;
    }
    for (const auto& lane : lanes) lane->loop.finish(source.cut_at_us());
    input.losses = source.losses();
    input.duration_s = static_cast<double>(input.digest->duration_us()) * 1e-6;
    return true;
  }

  Progress progress(const std::vector<std::unique_ptr<Lane>>& lanes, const CropSource& source,
                    const InputRun& input) const {
    std::int64_t frames = 0;
    for (const auto& lane : lanes) frames += lane->loop.frames();
    return {input.digest->events(), frames, input.digest->t_last_us().value_or(0), source.fraction_read(),
            index_};
  }

  bool is_whole() const { return config_.frames.interval() == Interval{}; }

  void refuse_nothing(const InputRun& input, const CropSource& source, const std::string& name) const {
    if (input.digest->events() == 0) {
      throw Error(fmt::format("{}: there are no events in the part that was asked for{}", name,
                              source.losses().any() ? " (lost: " + source.losses().text() + ")" : ""));
    }
    require_overlap(input.truth.truth, {*input.digest->t_first_us(), *input.digest->t_last_us() + 1},
                    is_whole(), name);
  }

  bool run_frames(InputRun& input) {
    const auto pictures = pictures_of(input.input, config_.frames.interval());
    require_overlap(input.truth.truth, {pictures.front().t_us, pictures.back().t_us + 1}, is_whole(),
                    input.input.path.string());
    JudgedFrames judged(config_, input.truth, pool_, detectors_, kFramesPerThread * (pool_.workers() + 1));
    judged.run().label = frames_label(input.input);
    Frame frame;
    for (const ListedPicture& picture : pictures) {
      frame.t_us = picture.t_us;
      frame.grey = picture_of(picture, input);
      judged.write(frame);
      ++frame.index;
      const double fraction = static_cast<double>(frame.index) / static_cast<double>(pictures.size());
      if (observer_ && !observer_({0, frame.index, picture.t_us, fraction, index_})) return false;
    }
    judged.finish("");
    input.duration_s = static_cast<double>(pictures.back().t_us - pictures.front().t_us) * 1e-6;
    input.methods.push_back(std::move(judged.run()));
    return true;
  }

  /// The first one says how large all are.
  static cv::Mat1b picture_of(const ListedPicture& listed, InputRun& input) {
    cv::Mat1b grey = read_picture(listed.file);
    const SensorSize size{grey.cols, grey.rows};
    if (input.size == SensorSize{}) {
      require_size_of_camera(input, size);
      input.size = size;
    }
    if (size == input.size) return grey;
    throw usage_error(fmt::format("{}: it is {} px large, the first frame of its folder {}",
                                  listed.file.string(), to_string(size), to_string(input.size)));
  }

  const EvalConfig& config_;
  const Observer& observer_;
  WorkerPool pool_;
  DetectorPool detectors_;
  std::size_t index_ = 0;
};

}  // namespace

std::vector<InputRun> load_inputs(const EvalConfig& config, const std::vector<EvalInput>& inputs) {
  std::vector<InputRun> runs;
  for (const EvalInput& input : inputs) {
    if (input.is_frames && config.frames.region()) {
      throw usage_error(input.path.string() + ": frames are judged whole; option roi is for recordings");
    }
    InputRun& run = runs.emplace_back();
    run.input = input;
    run.truth = load_truth(input.truth, config);
  }
  return runs;
}

std::string frames_label(const EvalInput& input) {
  return std::filesystem::weakly_canonical(input.path).filename().string();
}

Evaluation evaluate(const EvalConfig& config, std::vector<InputRun> inputs, int threads,
                    const Observer& observer) {
  config.check();
  cv::setNumThreads(1);  // frames are what goes on at the same time
  Evaluation evaluation;
  evaluation.inputs = std::move(inputs);
  Evaluator evaluator(config, threads, observer);
  for (std::size_t i = 0; i < evaluation.inputs.size() && !evaluation.stopped; ++i) {
    evaluation.stopped = !evaluator.run(evaluation.inputs[i], i);
  }
  return evaluation;
}

}  // namespace esi

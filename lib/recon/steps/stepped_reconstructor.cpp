#include "esi/recon/steps/stepped_reconstructor.hpp"

#include <algorithm>

namespace esi {
namespace {

/// Events are filtered and weighed in pieces that stay in cache.
constexpr std::size_t kPieceEvents = 4096;

class SteppedReconstructor final : public Reconstructor {
 public:
  SteppedReconstructor(std::unique_ptr<Reconstructor> method, const StepOptions& options,
                       const StepSurroundings& surroundings, RemovedEvents& removed)
      : method_(std::move(method)),
        removed_(removed),
        smoothing_(options.smoothing),
        stretch_(options.range) {
    const SensorSize size = surroundings.size;
    const auto hot = pixels_in_view(surroundings);
    if (!hot.empty()) hot_pixels_.emplace(hot, size);
    if (options.filters.refractory_us > 0) refractory_.emplace(options.filters.refractory_us, size);
    if (options.filters.background_us > 0) background_.emplace(options.filters.background_us, size);
    if (options.balance.balance) balance_.emplace(options.balance, size);
    if (surroundings.camera) undistortion_.emplace(*surroundings.camera, size, surroundings.corner);
    has_tone_ = options.smoothing.any() || options.range.range != Range::fixed || undistortion_;
  }

  void observe(const IntensityFrame& frame) override { method_->observe(frame); }

  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override {
    method_->render_levels(t_us, levels);
    smoothing_.apply(levels);
    stretch_.apply(levels);
    if (undistortion_) undistortion_->apply(levels);
  }

  const cv::Mat2f* motion() override { return method_->motion(); }

  void use_workers(std::shared_ptr<WorkerPool> workers) override { method_->use_workers(std::move(workers)); }

  void render(std::int64_t t_us, cv::Mat1b& grey) override {
    if (has_tone_) return Reconstructor::render(t_us, grey);
    method_->render(t_us, grey);
  }

 private:
  static std::vector<cv::Point> pixels_in_view(const StepSurroundings& surroundings) {
    std::vector<cv::Point> pixels;
    for (const cv::Point& pixel : surroundings.hot_pixels) {
      const cv::Point seen = pixel - surroundings.corner;
      if (surroundings.size.contains(seen.x, seen.y)) pixels.push_back(seen);
    }
    return pixels;
  }

  void take(std::span<const Event> events, std::span<const float> weights) override {
    while (!events.empty()) {
      const std::size_t count = std::min(kPieceEvents, events.size());
      events_.assign(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(count));
      weights_.assign(weights.begin(),
                      weights.begin() + static_cast<std::ptrdiff_t>(std::min(count, weights.size())));
      take_piece();
      events = events.subspan(count);
      if (!weights.empty()) weights = weights.subspan(count);
    }
  }

  void take_piece() {
    filter(hot_pixels_, removed_.hot_pixels);
    filter(refractory_, removed_.refractory);
    filter(background_, removed_.background);
    if (balance_) {
      weights_.resize(events_.size(), 1.0F);
      balance_->weigh(events_, weights_);
    }
    method_->process(events_, weights_);
  }

  template <class Filter>
  void filter(std::optional<Filter>& step, std::int64_t& removed) {
    if (step) removed += remove_unkept(*step, events_, weights_);
  }

  std::unique_ptr<Reconstructor> method_;
  RemovedEvents& removed_;
  std::optional<HotPixelFilter> hot_pixels_;
  std::optional<RefractoryFilter> refractory_;
  std::optional<BackgroundFilter> background_;
  std::optional<PolarityBalance> balance_;
  Smoothing smoothing_;
  RangeStretch stretch_;
  std::optional<Undistortion> undistortion_;
  bool has_tone_ = false;
  std::vector<Event> events_;
  std::vector<float> weights_;
};

bool any_chosen(const StepOptions& options, const StepSurroundings& surroundings) {
  return !surroundings.hot_pixels.empty() || options.filters.refractory_us > 0 ||
         options.filters.background_us > 0 || options.balance.balance || options.smoothing.any() ||
         options.range.range != Range::fixed || surroundings.camera;
}

}  // namespace

void StepOptions::declare(OptionTable& table) {
  filters.declare(table);
  balance.declare(table);
  smoothing.declare(table);
  range.declare(table);
}

std::unique_ptr<Reconstructor> with_steps(std::unique_ptr<Reconstructor> method, const StepOptions& options,
                                          const StepSurroundings& surroundings, RemovedEvents& removed) {
  options.range.check();
  if (!any_chosen(options, surroundings)) return method;
  return std::make_unique<SteppedReconstructor>(std::move(method), options, surroundings, removed);
}

}  // namespace esi

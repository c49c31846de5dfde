#include "esi/recon/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/recon/voxel_grid.hpp"

namespace esi {
namespace {

EventWindows windows_of(const NetworkOptions& options, SensorSize size) {
  if (options.window == NetworkOptions::Window::time) return EventWindows::of_duration(options.window_us);
  const double pixels = static_cast<double>(size.width_px) * size.height_px;
  return EventWindows::of_count(static_cast<std::size_t>(std::max(options.events_per_pixel * pixels, 1.0)));
}

/// A grid of no events, so that a sensor too large for the memory is found before any event is read.
cv::Mat grid_of(SensorSize size, int bins) {
  cv::Mat grid;
  try {
    fill_voxel_grid({}, {}, bins, size, grid);
  } catch (const cv::Exception&) {
    throw Error(
        fmt::format("network: a voxel grid of {} px in {} bins needs {:.1f} GB of memory, more than there is",
                    to_string(size), bins, 4e-9 * size.width_px * size.height_px * bins));
  }
  return grid;
}

NetworkModel model_of(const NetworkOptions& options, SensorSize size, const Padding& padding,
                      const FileReader& read_file) {
  if (options.model.empty()) {
    throw usage_error(
        "the method 'network' needs a model: make one with scripts/export_onnx CHECKPOINT MODEL.onnx and "
        "give "
        "it with --set model=MODEL.onnx");
  }
  if (!read_file) throw Error(options.model + ": nobody is there to read the model's file");
  return {read_file(options.model), options.model, size.height_px + padding.top + padding.bottom,
          size.width_px + padding.left + padding.right};
}

}  // namespace

void NetworkOptions::declare(OptionTable& table) {
  table.text("model", model, "ONNX file of the network, made by scripts/export_onnx");
  table.choice("window", window, {"events", "time"},
               "what ends a window: its number of events, or the clock");
  table.real("events_per_pixel", events_per_pixel, {0.01, 20.0}, "", "a window's events for each pixel");
  table.integer("window_us", window_us, {1000, 1'000'000}, "us", "how long a window of time lasts");
  table.toggle("normalise", normalise, "give the voxel grid's entries mean 0 and deviation 1");
  table.integer("pad_multiple", pad_multiple, {1, 256}, "px", "the image is padded to multiples of this");
  table.real("unsharp", unsharp, {0.0, 10.0}, "", "how much the image is sharpened");
  table.choice("range", range, {"fixed", "percentiles"},
               "what is shown black and white: 0 and 1, or the 1st and 99th percentile");
}

Network::Network(const NetworkOptions& options, SensorSize size, const FileReader& read_file)
    : options_(options),
      size_(size),
      padding_(Padding::to_multiple(size, static_cast<int>(options.pad_multiple))),
      windows_(windows_of(options, size)),
      model_(model_of(options, size, padding_, read_file)),
      grid_(grid_of(size, model_.form().bins)) {}

void Network::take(std::span<const Event> events, std::span<const float> weights) {
  windows_.add(events, weights, step());
}

EventWindows::Take Network::step() {
  return [this](std::span<const Event> window, std::span<const float> weights) {
    fill_voxel_grid(window, weights, model_.form().bins, size_, grid_);
    if (options_.normalise) normalise_non_zero(grid_);
    pad_reflected(grid_, padding_, padded_);
    image_ = model_.run(padded_);
  };
}

void Network::render_levels(std::int64_t t_us, cv::Mat1f& levels) {
  windows_.end_by(t_us, step());
  levels.create(size_.height_px, size_.width_px);
  if (image_.empty()) {
    levels.setTo(kMidGrey);
    return;
  }
  const cv::Mat1f sharp = options_.unsharp > 0.0 ? unsharp(image_, options_.unsharp) : image_;
  const cv::Mat1f shown = without_padding(sharp, padding_);
  if (options_.range == NetworkOptions::Range::fixed) {
    levels_between(shown, 0.0F, 1.0F, levels);
  } else {
    levels_between(shown, percentile(shown, 1.0), percentile(shown, 99.0), levels);
  }
}

}  // namespace esi

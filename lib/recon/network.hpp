#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/event_windows.hpp"
#include "esi/recon/methods.hpp"
#include "esi/recon/network_image.hpp"
#include "esi/recon/network_model.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// Recurrent networks over voxel grids: E2VID (Rebecq et al. 2019), FireNet (Scheerlinck et al. 2020),
/// FireNet+ (Stoffregen et al. 2020), and any other of that form; see docs/methods.md.
struct NetworkOptions {
  enum class Window { events, time };
  enum class Range { fixed, percentiles };

  std::string model;  ///< path of the ONNX file
  Window window = Window::events;
  double events_per_pixel = 0.35;
  std::int64_t window_us = 10'000;
  bool normalise = true;
  std::int64_t pad_multiple = 16;
  double unsharp = 0.3;
  Range range = Range::fixed;

  void declare(OptionTable& table);
};

class Network final : public Reconstructor {
 public:
  /// Reads the model through `read_file`. Throws a usage Error where the options name none, and an Error
  /// where it is no network of NetworkForm.
  Network(const NetworkOptions& options, SensorSize size, const FileReader& read_file);

  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override;
  /// What becomes of a window: a step of the network.
  EventWindows::Take step();

  NetworkOptions options_;
  SensorSize size_;
  Padding padding_;
  EventWindows windows_;
  NetworkModel model_;
  cv::Mat grid_, padded_;
  cv::Mat1f image_;  ///< of the last window, padded; empty before the first
};

}  // namespace esi

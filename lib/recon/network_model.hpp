#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "esi/recon/network_form.hpp"

namespace esi {

/// A recurrent network of an ONNX file, with its states. The one place that knows OpenCV's dnn.
class NetworkModel {
 public:
  /// `bytes` are the file's content, `name` is what messages call it. The grids will be height_px x width_px.
  /// Throws an Error where the bytes are no network of NetworkForm, or can't take grids of that size.
  NetworkModel(std::string_view bytes, std::string name, int height_px, int width_px);
  ~NetworkModel();
  NetworkModel(NetworkModel&&) noexcept;
  NetworkModel& operator=(NetworkModel&&) noexcept;

  const NetworkForm& form() const;

  /// One step: the image that belongs to a voxel grid (1 x bins x height x width) and to the states that
  /// earlier steps have left. The image is valid until the next step. Throws an Error where the network
  /// fails.
  const cv::Mat1f& run(const cv::Mat& voxel);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace esi

#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/eval/detection.hpp"
#include "esi/eval/detector_options.hpp"

namespace esi {

/// Finds AprilTags. It works in the thread that calls it, and keeps nothing from one image to the next; take
/// one per thread.
class TagDetector {
 public:
  /// Throws a usage Error for an unknown family or options that can't be. Making one with a large family
  /// takes some 0.1 s.
  explicit TagDetector(const DetectorOptions& options = {});
  ~TagDetector();
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;

  /// By id, then from left to right. Nothing in images too small to hold a tag, whatever their shape.
  std::vector<Detection> detect(const cv::Mat1b& grey);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace esi

#include "esi/eval/tag_detector.hpp"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "esi/core/error.hpp"
#include "esi/eval/tag_families.hpp"

namespace esi {
namespace {

struct Destroy {
  void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
  void operator()(zarray_t* detections) const { apriltag_detections_destroy(detections); }
};

void configure(apriltag_detector_t& detector, const DetectorOptions& options) {
  detector.nthreads = 1;
  detector.quad_decimate = static_cast<float>(options.quad_decimate);
  detector.quad_sigma = static_cast<float>(options.quad_sigma_px);
  detector.refine_edges = options.refine_edges;
  detector.decode_sharpening = options.decode_sharpening;
  detector.qtp.min_cluster_pixels = static_cast<int>(options.min_cluster_px);
  detector.qtp.max_nmaxima = static_cast<int>(options.max_maxima);
  detector.qtp.critical_rad = static_cast<float>(options.critical_angle_deg * std::numbers::pi / 180.0);
  detector.qtp.cos_critical_rad = std::cos(detector.qtp.critical_rad);
  detector.qtp.max_line_fit_mse = static_cast<float>(options.max_line_fit_mse_px2);
  detector.qtp.min_white_black_diff = static_cast<int>(options.min_contrast);
  detector.qtp.deglitch = options.deglitch ? 1 : 0;
}

/// libapriltag 3.3 reads beyond images that hold no tile of 4 px, or less than its blur's kernel.
int least_side_px(const DetectorOptions& options) {
  const int shrunk_px = std::max(8, static_cast<int>(4.0 * std::abs(options.quad_sigma_px)) + 2);
  return static_cast<int>(std::ceil(shrunk_px * options.quad_decimate));
}

// AprilTag's pixel centres are at +0.5.
Detection own_form(const apriltag_detection_t& found) {
  Detection detection{
      found.id, found.hamming, found.decision_margin, {found.c[0] - 0.5, found.c[1] - 0.5}, {}};
  for (std::size_t k = 0; k < 4; ++k) {
    detection.xy_px[2 * k] = found.p[k][0] - 0.5;
    detection.xy_px[2 * k + 1] = found.p[k][1] - 0.5;
  }
  return detection;
}

}  // namespace

struct TagDetector::Library {
  TagFamily family;
  std::unique_ptr<apriltag_detector_t, Destroy> detector;  // goes first, it uses the family
  double min_margin;
  int least_side_px;
};

TagDetector::TagDetector(const DetectorOptions& options) {
  options.check();
  library_.reset(new Library{make_tag_family(options.family),
                             std::unique_ptr<apriltag_detector_t, Destroy>(apriltag_detector_create()),
                             options.min_margin, least_side_px(options)});
  if (!library_->detector) throw Error("not enough memory for the tag detector");
  configure(*library_->detector, options);
  apriltag_detector_add_family_bits(library_->detector.get(), library_->family.get(),
                                    static_cast<int>(options.corrected_bits));
}

TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;

std::vector<Detection> TagDetector::detect(const cv::Mat1b& grey) {
  std::vector<Detection> detections;
  if (std::min(grey.rows, grey.cols) < library_->least_side_px) return detections;
  image_u8_t image{grey.cols, grey.rows, static_cast<int>(grey.step), grey.data};
  const std::unique_ptr<zarray_t, Destroy> found(apriltag_detector_detect(library_->detector.get(), &image));
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, static_cast<void*>(&detection));
    if (detection->decision_margin >= library_->min_margin) detections.push_back(own_form(*detection));
  }
  std::sort(detections.begin(), detections.end(), [](const Detection& a, const Detection& b) {
    return std::tuple(a.id, a.centre.x, a.centre.y) < std::tuple(b.id, b.centre.x, b.centre.y);
  });
  return detections;
}

}  // namespace esi

#include "esi/recon/edi.hpp"

#include <opencv2/core.hpp>

namespace esi {
namespace {

constexpr float kMidGrey = 127.5F;
/// Brighter than 20 000 times white is shown as that, so that grey levels stay within an int.
constexpr double kMostLog = 10.0;

}  // namespace

void EdiBase::render_levels(std::int64_t /*t_us*/, cv::Mat1f& levels) {
  if (!deblur_.has_frame()) {
    levels.create(size_.height_px, size_.width_px);
    levels.setTo(kMidGrey);
    return;
  }
  cv::exp(cv::min(log_shown(), kMostLog), levels);
  levels *= 255.0;
}

cv::Mat1f EdiPropagated::log_shown() const {
  cv::Mat1f log_now;
  cv::scaleAdd(deblur().events_since(), contrast(), deblur().log_sharp(), log_now);
  return log_now;
}

}  // namespace esi

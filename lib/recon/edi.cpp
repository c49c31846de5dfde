#include "esi/recon/edi.hpp"

#include <opencv2/core.hpp>

namespace esi {
namespace {

constexpr float kMidGrey = 127.5F;
/// Brighter than 20 000 times white is shown as that, so that grey levels stay within an int.
constexpr double kMostLog = 10.0;

void show_log(const cv::Mat1f& log_shares, cv::Mat1f& levels) {
  cv::exp(cv::min(log_shares, kMostLog), levels);
  levels *= 255.0;
}

void show_nothing(SensorSize size, cv::Mat1f& levels) {
  levels.create(size.height_px, size.width_px);
  levels.setTo(kMidGrey);
}

}  // namespace

void Edi::render_levels(std::int64_t /*t_us*/, cv::Mat1f& levels) {
  if (!deblur_.has_frame()) return show_nothing(size_, levels);
  show_log(deblur_.log_sharp(), levels);
}

void EdiPropagated::render_levels(std::int64_t /*t_us*/, cv::Mat1f& levels) {
  if (!deblur_.has_frame()) return show_nothing(size_, levels);
  cv::Mat1f log_now;
  cv::scaleAdd(deblur_.events_since(), deblur_.contrast(), deblur_.log_sharp(), log_now);
  show_log(log_now, levels);
}

}  // namespace esi

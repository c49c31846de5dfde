#include "esi/recon/reconstructor.hpp"

namespace esi {

void Reconstructor::render(std::int64_t t_us, cv::Mat1b& grey) {
  render_levels(t_us, levels_);
  levels_.convertTo(grey, CV_8U);
}

}  // namespace esi

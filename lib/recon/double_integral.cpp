#include "esi/recon/double_integral.hpp"

#include <cmath>

namespace esi {
namespace {

void integrate(DoubleIntegral::Pixel& pixel, std::int64_t to_us, double c) {
  const auto dt_us = static_cast<double>(to_us - pixel.t_us);
  const auto e = static_cast<double>(pixel.e);
  pixel.exp_integral += std::exp(c * e) * dt_us;
  pixel.plain_integral += e * dt_us;
  pixel.t_us = to_us;
}

}  // namespace

void DoubleIntegral::run(std::span<const SignedEvent> events, Interval exposure, std::int64_t reference_us,
                         double c) {
  for (Pixel& pixel : pixels_) pixel = {.t_us = exposure.begin_us};
  bool is_before_reference = true;
  const auto keep_reference = [&] {
    for (Pixel& pixel : pixels_) pixel.e_reference = pixel.e;
    is_before_reference = false;
  };
  for (const SignedEvent& event : events) {
    if (is_before_reference && event.t_us >= reference_us) keep_reference();
    Pixel& pixel = pixels_.at({event.t_us, event.x, event.y, true});
    integrate(pixel, event.t_us, c);
    pixel.e += event.p;
  }
  if (is_before_reference) keep_reference();
  for (Pixel& pixel : pixels_) integrate(pixel, exposure.end_us, c);
}

}  // namespace esi

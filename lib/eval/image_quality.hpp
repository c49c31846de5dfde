#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace esi {

/// The gain >= 0 and offset that bring an image closest to its reference, and what difference is left. The
/// gain is not negative: an image with black and white exchanged is no good reconstruction.
struct FittedError {
  double gain = 0.0, offset = 0.0;
  double mse = 0.0;               ///< grey levels squared
  std::optional<double> psnr_db;  ///< 10 log10(255^2 / mse); nothing for no difference at all
};
FittedError fitted_error(const cv::Mat1b& image, const cv::Mat1b& reference);

/// Structural similarity (Wang et al. 2004): Gaussian window of 11x11 px and 1.5 px, K1 = 0.01, K2 = 0.03,
/// L = 255, averaged over the windows that lie wholly inside. 1 for equal images, never above. The gain and
/// offset are applied to the image before.
double ssim(const cv::Mat1b& image, const cv::Mat1b& reference, double gain = 1.0, double offset = 0.0);

/// How a reconstruction compares with the clean frame of the same time.
struct ImageQuality {
  double ssim = 0.0;         ///< of the image as it is
  double ssim_fitted = 0.0;  ///< after the fit
  FittedError fit;
};
/// Throws a usage Error where the images differ in size, or have a side below 11 px; so do the two above.
ImageQuality compare_images(const cv::Mat1b& image, const cv::Mat1b& reference);

/// Variance of the Laplacian (Pech-Pacheco et al. 2000) over the variance of the image, so that gain and
/// offset make no difference: 0 for a ramp, 20 for white noise, 64 for a chessboard of pixels. Noise counts
/// as detail; compare it only at like noise. Nothing for a constant image or one below 3x3 px.
std::optional<double> sharpness(const cv::Mat1b& image);

}  // namespace esi

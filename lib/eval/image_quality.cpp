#include "esi/eval/image_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr int kWindow_px = 11;
constexpr double kWindowSigma_px = 1.5;

void require_comparable(const cv::Mat1b& image, const cv::Mat1b& reference) {
  if (image.size() != reference.size()) {
    throw usage_error(fmt::format("an image of {}x{} can't be compared with one of {}x{}", image.cols,
                                  image.rows, reference.cols, reference.rows));
  }
  if (std::min(image.rows, image.cols) < kWindow_px) {
    throw usage_error(fmt::format("an image of {}x{} is too small to be compared, it takes {} px a side",
                                  image.cols, image.rows, kWindow_px));
  }
}

/// Weighted means over the windows that lie wholly inside.
cv::Mat1d window_means(const cv::Mat1d& image) {
  cv::Mat1d means;
  cv::GaussianBlur(image, means, {kWindow_px, kWindow_px}, kWindowSigma_px);
  const int edge = kWindow_px / 2;
  return means(cv::Range(edge, means.rows - edge), cv::Range(edge, means.cols - edge));
}

/// The same of the product of two images.
cv::Mat1d window_means(const cv::Mat1d& a, const cv::Mat1d& b) {
  cv::Mat1d product;
  cv::multiply(a, b, product);
  return window_means(product);
}

double variance(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0] * deviation[0];
}

}  // namespace

FittedError fitted_error(const cv::Mat1b& image, const cv::Mat1b& reference) {
  require_comparable(image, reference);
  const double n = static_cast<double>(image.total());
  const double image_mean = cv::mean(image)[0], reference_mean = cv::mean(reference)[0];
  const double image_variance = variance(image), reference_variance = variance(reference);
  cv::Mat1d a, b;
  image.convertTo(a, CV_64F);
  reference.convertTo(b, CV_64F);
  const double covariance = a.dot(b) / n - image_mean * reference_mean;
  FittedError fit;
  fit.gain = image_variance > 0.0 ? std::max(0.0, covariance / image_variance) : 0.0;
  fit.offset = reference_mean - fit.gain * image_mean;
  // Rounding leaves some 1e-11 of nothing: differences of 8-bit images are either 0 or far above.
  const double mse = reference_variance - 2.0 * fit.gain * covariance + fit.gain * fit.gain * image_variance;
  fit.mse = mse > 1e-9 ? mse : 0.0;
  if (fit.mse > 0.0) fit.psnr_db = 10.0 * std::log10(255.0 * 255.0 / fit.mse);
  return fit;
}

double ssim(const cv::Mat1b& image, const cv::Mat1b& reference, double gain, double offset) {
  require_comparable(image, reference);
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  cv::Mat1d x, y;
  image.convertTo(x, CV_64F, gain, offset);
  reference.convertTo(y, CV_64F);
  const cv::Mat1d mean_x = window_means(x), mean_y = window_means(y);
  const cv::Mat1d mean_xx = window_means(x, x), mean_yy = window_means(y, y), mean_xy = window_means(x, y);
  double sum = 0.0;
  for (int row = 0; row < mean_x.rows; ++row) {
    for (int column = 0; column < mean_x.cols; ++column) {
      const double mx = mean_x(row, column), my = mean_y(row, column);
      const double both = mx * my, squares = mx * mx + my * my;
      const double covariance = mean_xy(row, column) - both;
      const double variances = mean_xx(row, column) + mean_yy(row, column) - squares;
      sum += (2.0 * both + c1) * (2.0 * covariance + c2) / ((squares + c1) * (variances + c2));
    }
  }
  return sum / static_cast<double>(mean_x.total());
}

ImageQuality compare_images(const cv::Mat1b& image, const cv::Mat1b& reference) {
  ImageQuality quality;
  quality.fit = fitted_error(image, reference);
  quality.ssim = ssim(image, reference);
  quality.ssim_fitted = ssim(image, reference, quality.fit.gain, quality.fit.offset);
  return quality;
}

std::optional<double> sharpness(const cv::Mat1b& image) {
  if (std::min(image.rows, image.cols) < 3) return std::nullopt;
  const double contrast = variance(image);
  if (contrast == 0.0) return std::nullopt;
  cv::Mat laplacian;
  cv::Laplacian(image, laplacian, CV_16S, 1);
  return variance(laplacian(cv::Range(1, image.rows - 1), cv::Range(1, image.cols - 1))) / contrast;
}

}  // namespace esi

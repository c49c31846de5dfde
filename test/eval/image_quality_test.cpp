#include "esi/eval/image_quality.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "esi/core/error.hpp"

using namespace esi;

namespace {

cv::Mat1b noise(int rows, int cols, int seed, int from = 0, int to = 256) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat1b image(rows, cols);
  random.fill(image, cv::RNG::UNIFORM, from, to);
  return image;
}

cv::Mat1b affine(const cv::Mat1b& image, double gain, double offset) {
  cv::Mat1b result;
  image.convertTo(result, CV_8U, gain, offset);
  return result;
}

double variance(const cv::Mat1b& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0] * deviation[0];
}

/// Window by window, as the paper's equations stand.
double plain_ssim(const cv::Mat1b& x, const cv::Mat1b& y) {
  double weight_sum = 0.0, weights[11][11];
  for (int i = 0; i < 11; ++i) {
    for (int j = 0; j < 11; ++j) {
      weight_sum += weights[i][j] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2.0 * 1.5 * 1.5));
    }
  }
  double sum = 0.0;
  int windows = 0;
  for (int row = 0; row + 11 <= x.rows; ++row) {
    for (int column = 0; column + 11 <= x.cols; ++column, ++windows) {
      double mx = 0, my = 0, vx = 0, vy = 0, cov = 0;
      const auto each = [&](auto take) {
        for (int i = 0; i < 11; ++i) {
          for (int j = 0; j < 11; ++j)
            take(weights[i][j] / weight_sum, x(row + i, column + j), y(row + i, column + j));
        }
      };
      each([&](double w, double a, double b) { mx += w * a, my += w * b; });
      each([&](double w, double a, double b) {
        vx += w * (a - mx) * (a - mx), vy += w * (b - my) * (b - my), cov += w * (a - mx) * (b - my);
      });
      const double c1 = 6.5025, c2 = 58.5225;
      sum += (2 * mx * my + c1) * (2 * cov + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
    }
  }
  return sum / windows;
}

}  // namespace

TEST_CASE("An image equals itself") {
  const cv::Mat1b image = noise(40, 50, 1);
  const ImageQuality quality = compare_images(image, image);
  CHECK(quality.ssim == Approx(1.0));
  CHECK(quality.ssim_fitted == Approx(1.0));
  CHECK(quality.fit.gain == Approx(1.0));
  CHECK(quality.fit.offset == Approx(0.0).margin(1e-9));
  CHECK(quality.fit.mse == 0.0);
  CHECK_FALSE(quality.fit.psnr_db);
}

TEST_CASE("SSIM is the paper's, window by window") {
  const cv::Mat1b a = noise(23, 31, 2), b = noise(23, 31, 3);
  cv::Mat1b near;
  cv::addWeighted(a, 0.8, b, 0.2, 0.0, near);
  CHECK(ssim(a, b) == Approx(plain_ssim(a, b)).margin(1e-9));
  CHECK(ssim(a, near) == Approx(plain_ssim(a, near)).margin(1e-9));
  CHECK(ssim(a, near) > 0.9);
}

TEST_CASE("Gain and offset are fitted away, but not an exchange of black and white") {
  cv::Mat1b reference = noise(40, 50, 4, 0, 128);
  reference *= 2;
  const ImageQuality dull = compare_images(affine(reference, 0.5, 20), reference);
  CHECK(dull.fit.gain == Approx(2.0));
  CHECK(dull.fit.offset == Approx(-40.0));
  CHECK(dull.fit.mse == 0.0);
  CHECK(dull.ssim < 0.9);
  CHECK(dull.ssim_fitted == Approx(1.0));
  const ImageQuality inverted = compare_images(affine(reference, -1.0, 255), reference);
  CHECK(inverted.fit.gain == 0.0);
  CHECK(inverted.fit.mse == Approx(variance(reference)));
  CHECK(inverted.fit.psnr_db == Approx(10 * std::log10(255 * 255 / variance(reference))));
  CHECK(inverted.ssim < 0.0);
}

TEST_CASE("The fit is the least squares one") {
  const cv::Mat1b a = noise(30, 30, 5), b = noise(30, 30, 6);
  cv::Mat1b image;
  cv::addWeighted(a, 0.6, b, 0.4, 0.0, image);
  const FittedError fit = fitted_error(image, a);
  const auto error = [&](double gain, double offset) {
    double sum = 0.0;
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) sum += std::pow(gain * image(y, x) + offset - a(y, x), 2);
    }
    return sum / 900.0;
  };
  CHECK(fit.mse == Approx(error(fit.gain, fit.offset)));
  CHECK(fit.mse > 100.0);
  for (const double step : {-0.01, 0.01}) {
    CHECK(error(fit.gain + step, fit.offset) > fit.mse);
    CHECK(error(fit.gain, fit.offset + 10 * step) > fit.mse);
  }
}

TEST_CASE("Constant images give numbers") {
  const cv::Mat1b grey(20, 20, 100), black(20, 20, std::uint8_t{0}), texture = noise(20, 20, 7);
  const ImageQuality nothing = compare_images(grey, texture);
  CHECK(nothing.fit.gain == 0.0);
  CHECK(nothing.fit.mse == Approx(variance(texture)));
  CHECK(nothing.ssim == Approx(plain_ssim(grey, texture)).margin(1e-9));
  const ImageQuality levels = compare_images(black, grey);
  CHECK(levels.ssim == Approx(6.5025 / (100 * 100 + 6.5025)));
  CHECK(levels.ssim_fitted == Approx(1.0));
  CHECK(levels.fit.mse == 0.0);
  CHECK_FALSE(sharpness(grey));
  CHECK(compare_images(texture, grey).fit.gain == 0.0);
}

TEST_CASE("Images of other or too small sizes are refused") {
  CHECK_THROWS_WITH(compare_images(noise(20, 20, 1), noise(20, 21, 1)),
                    Catch::Contains("20x20") && Catch::Contains("21x20"));
  CHECK_THROWS_WITH(ssim(noise(10, 20, 1), noise(10, 20, 1)), Catch::Contains("too small"));
  CHECK_NOTHROW(compare_images(noise(11, 11, 1), noise(11, 11, 1)));
  CHECK_THROWS_AS(fitted_error(cv::Mat1b(), cv::Mat1b()), Error);
}

TEST_CASE("Sharpness knows a ramp, noise and a chessboard, and no gain") {
  cv::Mat1b ramp(20, 60), board(40, 40);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 60; ++x) ramp(y, x) = static_cast<std::uint8_t>(4 * x);
  }
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) board(y, x) = (x + y) % 2 == 0 ? 50 : 60;
  }
  CHECK(sharpness(ramp) == Approx(0.0).margin(1e-12));
  CHECK(sharpness(board) == Approx(64.0));
  const cv::Mat1b grains = noise(200, 200, 8, 0, 60);
  CHECK(sharpness(grains) == Approx(20.0).epsilon(0.05));
  CHECK(sharpness(affine(grains, 3.0, 20.0)) == Approx(*sharpness(grains)));
  cv::Mat1b blurred;
  cv::GaussianBlur(grains, blurred, {}, 1.0);
  CHECK(*sharpness(blurred) < 2.0);
  CHECK_FALSE(sharpness(noise(2, 50, 1)));
}

#include "esi/pipeline/evaluation/sample_strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <span>
#include <tuple>

#include "esi/io/output/encode_png.hpp"

namespace esi {
namespace {

constexpr int kGap_px = 4;
constexpr int kPngLevel = 6;
/// Wider frames are shrunk to this.
constexpr int kWidest_px = 346;

std::vector<const SampleFrame*> in_order(const MethodRun& run) {
  std::vector<const SampleFrame*> samples;
  for (const SampleFrame& sample : run.samples) samples.push_back(&sample);
  std::sort(samples.begin(), samples.end(), [](const SampleFrame* a, const SampleFrame* b) {
    return std::tuple(a->phase, !a->is_detected) < std::tuple(b->phase, !b->is_detected);
  });
  return samples;
}

/// White beside black, to be seen on any ground.
void outline(cv::Mat1b& grey, const Detection& tag) {
  std::vector<cv::Point> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners.emplace_back(cvRound(tag.xy_px[2 * i]), cvRound(tag.xy_px[2 * i + 1]));
  }
  cv::polylines(grey, corners, true, cv::Scalar(0), 3);
  cv::polylines(grey, corners, true, cv::Scalar(255), 1);
}

cv::Mat1b tile_of(const SampleFrame& sample) {
  cv::Mat1b tile = sample.grey.clone();
  for (const Detection& tag : sample.detections) outline(tile, tag);
  if (tile.cols > kWidest_px) {
    const double scale = static_cast<double>(kWidest_px) / tile.cols;
    cv::resize(tile, tile, {}, scale, scale, cv::INTER_AREA);
  }
  return tile;
}

}  // namespace

std::vector<std::byte> sample_strip(const MethodRun& run) {
  std::vector<cv::Mat> tiles;
  for (const SampleFrame* const sample : in_order(run)) {
    if (!tiles.empty()) tiles.emplace_back(cv::Mat1b(tiles.front().rows, kGap_px, std::uint8_t{255}));
    tiles.emplace_back(tile_of(*sample));
  }
  if (tiles.empty()) return {};
  cv::Mat strip;
  cv::hconcat(tiles, strip);
  const std::vector<std::uint8_t> png = encode_png(strip, kPngLevel);
  const auto bytes = std::as_bytes(std::span(png));
  return {bytes.begin(), bytes.end()};
}

std::string sample_text(const MethodRun& run, const std::vector<Phase>& phases) {
  std::string text;
  for (const SampleFrame* const sample : in_order(run)) {
    text += fmt::format("{}{}: {} at {:.2f} s", text.empty() ? "" : "; ", phases[sample->phase].name,
                        sample->is_detected ? "found" : "missed", static_cast<double>(sample->t_us) * 1e-6);
  }
  return text;
}

}  // namespace esi

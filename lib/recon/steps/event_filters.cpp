#include "esi/recon/steps/event_filters.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr std::int64_t kLongest_us = 10'000'000;
static_assert(kLongest_us <= RecentTimes::kLongest_us);

// Reads a number off the front of `text`.
std::optional<int> take_coordinate(std::string_view& text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || value < 0 || value >= kMaxSensorSide_px) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

void check_hot_pixels(const std::string& text) {
  if (text != "learn") parse_pixels(text);
}

}  // namespace

void EventFilterOptions::declare_background(OptionTable& table, std::int64_t& background_us) {
  table.integer("background_us", background_us, {0, kLongest_us}, "us",
                "background activity: keep events with one at a neighbouring pixel this shortly before");
}

void EventFilterOptions::declare(OptionTable& table) {
  table.text("hot_pixels", hot_pixels,
             "leave these pixels out: 'X,Y X,Y', as --check lists them, or 'learn' to look for them first",
             check_hot_pixels);
  table.integer("refractory_us", refractory_us, {0, kLongest_us}, "us",
                "leave out what follows its pixel's last kept event more shortly");
  declare_background(table, background_us);
}

std::vector<cv::Point> parse_pixels(std::string_view text) {
  std::vector<cv::Point> pixels;
  std::string_view rest = text;
  while (true) {
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    if (rest.empty()) return pixels;
    const auto x = take_coordinate(rest);
    const bool has_comma = x && !rest.empty() && rest.front() == ',';
    if (has_comma) rest.remove_prefix(1);
    const auto y = has_comma ? take_coordinate(rest) : std::nullopt;
    if (!y || (!rest.empty() && rest.front() != ' ')) {
      throw usage_error(fmt::format("pixels '{}': write X,Y for each, such as '12,40 13,41'", text));
    }
    pixels.emplace_back(*x, *y);
  }
}

HotPixelFilter::HotPixelFilter(std::span<const cv::Point> hot, SensorSize size)
    : width_px_(static_cast<std::size_t>(size.width_px)),
      is_hot_(width_px_ * static_cast<std::size_t>(size.height_px)) {
  for (const cv::Point& pixel : hot) {
    if (!size.contains(pixel.x, pixel.y)) {
      throw usage_error(
          fmt::format("hot_pixels: {},{} lies outside the sensor of {}", pixel.x, pixel.y, to_string(size)));
    }
    is_hot_[static_cast<std::size_t>(pixel.y) * width_px_ + static_cast<std::size_t>(pixel.x)] = true;
  }
}

}  // namespace esi

#include "esi/io/check/recording_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace esi {
namespace {

// A pause is worth telling if it is both long and many times longer than what lies between most events.
constexpr std::int64_t kShortestGap_us = 50'000;
constexpr std::int64_t kGapIntervals = 50;
// Real recordings of real scenes have ON shares of 30 to 60 %.
constexpr double kLeastShare = 0.1;

double share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::int64_t gap_limit_us(const EventDigest& digest) {
  const std::int64_t mean_us = digest.duration_us() / std::max<std::int64_t>(1, digest.events());
  return std::max(kShortestGap_us, kGapIntervals * mean_us);
}

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; }

std::int64_t events_of(const std::vector<HotPixel>& pixels) {
  return std::accumulate(pixels.begin(), pixels.end(), std::int64_t{0},
                         [](std::int64_t sum, const HotPixel& pixel) { return sum + pixel.events; });
}

std::vector<std::string> findings_of(const CheckReport& report, const RecordingInfo& info) {
  std::vector<std::string> findings;
  const EventDigest& digest = info.digest;
  if (digest.events() == 0) findings.emplace_back("there are no events");
  if (info.losses.any()) findings.push_back("damaged or out of range: " + info.losses.text());
  if (!report.gaps.empty()) {
    const auto longest = *std::max_element(
        report.gaps.begin(), report.gaps.end(),
        [](const Interval& a, const Interval& b) { return a.duration_us() < b.duration_us(); });
    findings.push_back(fmt::format("{}{} pauses longer than {:.3f} s, the longest {:.3f} s at {:.6f} s",
                                   report.gaps.size(), report.gaps.size() == Gaps::kMost ? " or more" : "",
                                   seconds(report.gap_limit_us), seconds(longest.duration_us()),
                                   seconds(longest.begin_us)));
  }
  if (!report.hot_pixels.empty()) {
    findings.push_back(fmt::format("{} hot pixels make {:.2f} % of the events", report.hot_pixels.size(),
                                   100.0 * share(events_of(report.hot_pixels), digest.events())));
  }
  const double on_share = share(digest.on(), digest.events());
  if (digest.events() > 0 && (on_share < kLeastShare || on_share > 1.0 - kLeastShare)) {
    findings.push_back(
        fmt::format("{:.1f} % of the events are ON: is the polarity read right?", 100.0 * on_share));
  }
  return findings;
}

/// A bar per bin, from the lowest to the highest rate.
std::string sparkline(std::span<const std::int64_t> bins) {
  static constexpr const char* kBars[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  const std::int64_t most = bins.empty() ? 0 : *std::max_element(bins.begin(), bins.end());
  std::string line;
  for (const std::int64_t events : bins) line += kBars[most == 0 ? 0 : (8 * events + most - 1) / most];
  return line;
}

/// Events per second over a bin.
double rate_hz(std::int64_t events, const EventRate& rate) {
  return static_cast<double>(events) / seconds(rate.bin_us());
}

}  // namespace

CheckReport check_recording(EventSource& source, RecordingInfo& info) {
  CheckReport report;
  Gaps gaps;
  PixelCounts pixels;
  info = inspect(source, [&](const Packet& packet) {
    report.rate.add(packet.events);
    gaps.add(packet.events);
    pixels.add(packet.events);
  });
  report.gap_limit_us = gap_limit_us(info.digest);
  report.gaps = gaps.longer_than(report.gap_limit_us);
  report.hot_pixels = pixels.hot_pixels();
  report.counted_pixels = !pixels.gave_up();
  report.findings = findings_of(report, info);
  return report;
}

std::string hot_pixel_list(const std::vector<HotPixel>& pixels) {
  std::string list;
  for (const HotPixel& pixel : pixels)
    list += fmt::format("{}{},{}", list.empty() ? "" : " ", pixel.x, pixel.y);
  return list;
}

nlohmann::json to_json(const CheckReport& report, const RecordingInfo& info) {
  nlohmann::json gaps = nlohmann::json::array();
  for (const Interval& gap : report.gaps)
    gaps.push_back({{"begin_us", gap.begin_us}, {"end_us", gap.end_us}});
  nlohmann::json hot = nlohmann::json::array();
  for (const HotPixel& pixel : report.hot_pixels) {
    hot.push_back({{"x", pixel.x}, {"y", pixel.y}, {"events", pixel.events}});
  }
  return {
      {"good", report.is_good()},
      {"findings", report.findings},
      {"rate", {{"bin_us", report.rate.bin_us()}, {"events", report.rate.bins()}}},
      {"gap_limit_us", report.gap_limit_us},
      {"gaps", gaps},
      {"on_share", share(info.digest.on(), info.digest.events())},
      {"hot_pixels", report.counted_pixels ? hot : nlohmann::json()},
      {"hot_pixel_list", hot_pixel_list(report.hot_pixels)},
  };
}

std::string to_text(const CheckReport& report) {
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<12} {}\n", name, value);
  };
  const auto bins = report.rate.bins();
  if (!bins.empty()) {
    const auto whole = bins.first(std::max<std::size_t>(1, bins.size() - 1));  // the last one is not full
    const auto [least, most] = std::minmax_element(whole.begin(), whole.end());
    line("event rate", fmt::format("|{}| {:.3g} to {:.3g} Mev/s, {:.3f} s a bar", sparkline(bins),
                                   rate_hz(*least, report.rate) * 1e-6, rate_hz(*most, report.rate) * 1e-6,
                                   seconds(report.rate.bin_us())));
  }
  for (const Interval& gap : report.gaps) {
    line("pause", fmt::format("{:.6f} s to {:.6f} s", seconds(gap.begin_us), seconds(gap.end_us)));
  }
  if (!report.counted_pixels) line("hot pixels", "not looked for: the coordinates are too large");
  if (!report.hot_pixels.empty()) line("hot pixels", hot_pixel_list(report.hot_pixels));
  for (const std::string& finding : report.findings) line("FINDING", finding);
  line("verdict", report.is_good() ? "good" : "see the findings");
  return text;
}

}  // namespace esi

#include "esi/sim/tum_poses.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {
namespace {

constexpr std::string_view kBlanks = " \t\r";
/// Seconds beyond which a double no longer tells microseconds apart; some 285 years.
constexpr double kLongest_s = 9e9;

/// The line's numbers, or nothing where it isn't eight finite numbers.
std::optional<std::array<double, 8>> numbers_in(std::string_view line) {
  std::array<double, 8> numbers{};
  for (double& number : numbers) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    if (!line.empty() && kBlanks.find(line.front()) == std::string_view::npos) return std::nullopt;
  }
  if (line.find_first_not_of(kBlanks) != std::string_view::npos) return std::nullopt;
  return numbers;
}

std::optional<TimedPose> pose_in(std::string_view line) {
  const auto n = numbers_in(line);
  if (!n) return std::nullopt;
  const auto& [t_s, x, y, z, qx, qy, qz, qw] = *n;
  const double norm = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
  if (std::abs(t_s) > kLongest_s || !(norm > 1e-6) || !std::isfinite(norm)) return std::nullopt;
  const Quaternion unit{qx / norm, qy / norm, qz / norm, qw / norm};
  return TimedPose{us_from_seconds(t_s), {rotation_of(unit), {x, y, z}}};
}

}  // namespace

std::vector<TimedPose> parse_tum_poses(std::string_view text, const std::string& name) {
  std::vector<TimedPose> poses;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    const std::optional<TimedPose> pose = pose_in(line);
    if (!pose) {
      throw Error(fmt::format("{}: no pose in line {}, write 't tx ty tz qx qy qz qw' in seconds and metres",
                              name, line_number));
    }
    if (!poses.empty() && pose->t_us <= poses.back().t_us) {
      throw Error(fmt::format("{}: the time in line {} is not after the one before, sort the poses by time",
                              name, line_number));
    }
    poses.push_back(*pose);
  }
  if (poses.empty()) throw Error(name + ": no poses in it, write lines 't tx ty tz qx qy qz qw'");
  return poses;
}

}  // namespace esi

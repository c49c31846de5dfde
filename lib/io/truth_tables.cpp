#include "esi/io/truth_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

constexpr std::string_view kCornerColumns = "t_s,id,visible,x1,y1,x2,y2,x3,y3,x4,y4";
constexpr std::string_view kBlanks = " \t\r";
/// Seconds beyond which a double no longer tells microseconds apart; some 285 years.
constexpr double kLongest_s = 9e9;
constexpr double kLargestId = 100000;

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Calls `take(line)` for the lines that hold something. What it throws gets the names of file and line.
template <class Take>
void for_each_line(const std::filesystem::path& path, Take take) {
  const std::string text = read_text_file(path);
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xef\xbb\xbf") rest.remove_prefix(3);
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view whole = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(whole.size() + 1, rest.size()));
    const std::string_view line = trimmed(whole);
    if (line.empty() || line.front() == '#') continue;
    try {
      take(line);
    } catch (const Error& error) {
      throw usage_error(fmt::format("{}: line {}: {}", path.string(), number, error.what()));
    }
  }
}

/// Whether the text is exactly numbers.size() finite numbers; blanks beside a separator don't matter.
bool parse_numbers(std::string_view text, char separator, std::span<double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text = trimmed(text);
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
    if (error != std::errc{} || !std::isfinite(numbers[i])) return false;
    const std::string_view behind = text.substr(static_cast<std::size_t>(stop - text.data()));
    text = trimmed(behind);
    if (i + 1 == numbers.size()) break;
    if (separator == ' ') {
      if (behind.size() == text.size()) return false;  // nothing between this number and the next
      continue;
    }
    if (text.empty() || text.front() != separator) return false;
    text.remove_prefix(1);
  }
  return text.empty();
}

std::int64_t time_us(double t_s) {
  if (std::abs(t_s) > kLongest_s) throw usage_error(fmt::format("{} s is no time", t_s));
  return us_from_seconds(t_s);
}

TrueCorners parse_corners(std::string_view line) {
  std::array<double, 11> numbers{};
  if (!parse_numbers(line, ',', numbers)) {
    throw usage_error(
        fmt::format("it is not {} finite numbers with commas, as {}", numbers.size(), kCornerColumns));
  }
  const double id = numbers[1], visible = numbers[2];
  if (id < 0 || id > kLargestId || id != std::floor(id))
    throw usage_error(fmt::format("{} is no tag's id", id));
  if (visible != 0 && visible != 1) throw usage_error(fmt::format("visible is {}, write 0 or 1", visible));
  TrueCorners corners{time_us(numbers[0]), static_cast<int>(id), visible == 1, {}};
  std::copy(numbers.begin() + 3, numbers.end(), corners.xy_px.begin());
  return corners;
}

TrackPose parse_pose(std::string_view line) {
  std::array<double, 8> n{};
  if (!parse_numbers(line, ' ', n)) {
    throw usage_error("it is no pose, write 't tx ty tz qx qy qz qw' in seconds and metres");
  }
  const double length = std::hypot(std::hypot(n[4], n[5]), std::hypot(n[6], n[7]));
  if (!(length > 1e-6) || !std::isfinite(length)) throw usage_error("its quaternion is no rotation");
  return {time_us(n[0]), {n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7]}};
}

}  // namespace

std::vector<TrueCorners> read_corners(const std::filesystem::path& path) {
  std::vector<TrueCorners> rows;
  std::map<int, std::int64_t> latest_us;
  bool has_header = false;
  for_each_line(path, [&](std::string_view line) {
    if (!std::exchange(has_header, true)) {
      if (line == kCornerColumns) return;
      throw usage_error(fmt::format("it must be the header {}", kCornerColumns));
    }
    const TrueCorners row = parse_corners(line);
    if (!rows.empty() && row.t_us < rows.back().t_us) {
      throw usage_error("its time is before the one of the row above, sort the rows by time");
    }
    const auto [latest, is_first] = latest_us.try_emplace(row.id, row.t_us);
    if (!is_first && std::exchange(latest->second, row.t_us) == row.t_us) {
      throw usage_error(fmt::format("tag {} is there twice at {} s", row.id, seconds_text(row.t_us)));
    }
    rows.push_back(row);
  });
  if (rows.empty()) throw usage_error(fmt::format("{}: there are no corners in it", path.string()));
  return rows;
}

std::vector<TrackPose> read_track(const std::filesystem::path& path) {
  std::vector<TrackPose> poses;
  for_each_line(path, [&](std::string_view line) {
    const TrackPose pose = parse_pose(line);
    if (!poses.empty() && pose.t_us <= poses.back().t_us) {
      throw usage_error("its time is not after the one above, sort the poses by time");
    }
    poses.push_back(pose);
  });
  if (poses.empty()) {
    throw usage_error(
        fmt::format("{}: there are no poses in it, write lines 't tx ty tz qx qy qz qw'", path.string()));
  }
  return poses;
}

}  // namespace esi

#include "esi/io/picture_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/io/times_file.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code absent;
  return fs::is_regular_file(path, absent);
}

/// "<seconds> <file>"
std::optional<ListedPicture> parse_line(std::string_view line, const fs::path& folder) {
  double t_s = 0;
  const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), t_s);
  line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
  const std::size_t name = line.find_first_not_of(" \t");
  constexpr double kLongest_s = 1e12;  // keeps microseconds within 64 bits
  if (error != std::errc{} || !(std::abs(t_s) < kLongest_s) || name == 0 || name == std::string_view::npos)
    return std::nullopt;
  return ListedPicture{us_from_seconds(t_s), folder / line.substr(name)};
}

std::vector<fs::path> png_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<ListedPicture> with_timestamps(const fs::path& folder, const fs::path& list) {
  const std::vector<std::int64_t> times_us = read_times(list);
  std::vector<fs::path> files = png_files_in(folder);
  if (files.size() != times_us.size()) {
    throw usage_error(fmt::format("{}: has {} times for {} PNG files beside it; give one time for each frame",
                                  list.string(), times_us.size(), files.size()));
  }
  std::vector<ListedPicture> frames;
  for (std::size_t i = 0; i < files.size(); ++i) frames.push_back({times_us[i], std::move(files[i])});
  return frames;
}

}  // namespace

std::vector<ListedPicture> read_picture_list(const fs::path& path) {
  const std::string text = read_text_file(path);
  std::vector<ListedPicture> pictures;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    auto picture = parse_line(line, path.parent_path());
    if (!picture) {
      throw Error(fmt::format("{}: line {} is not a time in seconds and a picture's name", path.string(),
                              line_number));
    }
    pictures.push_back(std::move(*picture));
  }
  const auto is_earlier = [](const ListedPicture& a, const ListedPicture& b) { return a.t_us < b.t_us; };
  std::stable_sort(pictures.begin(), pictures.end(), is_earlier);
  return pictures;
}

std::vector<ListedPicture> list_frames(const fs::path& folder) {
  const fs::path images = folder / "images.txt";
  const fs::path timestamps = folder / "timestamps.txt";
  if (!is_file(images) && !is_file(timestamps)) {
    throw usage_error(fmt::format(
        "{}: holds neither images.txt nor timestamps.txt; the frames' times are needed", folder.string()));
  }
  std::vector<ListedPicture> frames =
      is_file(images) ? read_picture_list(images) : with_timestamps(folder, timestamps);
  for (const ListedPicture& frame : frames) {
    if (!is_file(frame.file))
      throw usage_error(frame.file.string() + ": is listed in the folder but is not there");
  }
  if (frames.empty()) throw usage_error(folder.string() + ": its list of frames is empty");
  return frames;
}

cv::Mat1b read_picture(const fs::path& file) {
  cv::Mat grey;
  if (is_file(file)) grey = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);  // it prints where there is none
  if (grey.empty()) throw Error(file.string() + ": is not a picture that can be read");
  return grey;
}

}  // namespace esi

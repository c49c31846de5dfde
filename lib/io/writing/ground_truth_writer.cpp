#include "esi/io/writing/ground_truth_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "esi/core/error.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Exact, without zeros at the end: "12.5", "3".
std::string short_seconds(std::int64_t t_us) {
  std::string text = seconds_text(t_us);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// The shortest text that reads back as the same number.
void append_numbers(std::string& line, char separator, std::span<const double> numbers,
                    const std::string& name) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) {
      throw Error(
          fmt::format("{}: {} cannot be written, only finite numbers; line so far: {}", name, number, line));
    }
    fmt::format_to(std::back_inserter(line), "{}{}", separator, number);
  }
}

Json phases_json(const std::vector<Phase>& phases) {
  Json list = Json::array();
  for (const Phase& phase : phases) {
    list.push_back({{"name", phase.name},
                    {"start_s", static_cast<double>(phase.interval.begin_us) / 1e6},
                    {"end_s", static_cast<double>(phase.interval.end_us) / 1e6}});
  }
  return list;
}

Json tags_json(const TrueTags& tags) {
  Json sizes = Json::object();
  for (const auto& [id, size_m] : tags.size_m) sizes[std::to_string(id)] = size_m;
  return {{"family", tags.family}, {"ids", tags.ids}, {"size_m", sizes}};
}

Json camera_json(const CameraModel& camera) {
  return {{"width", camera.width_px},
          {"height", camera.height_px},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

Json truth_json(const GroundTruth& truth, const fs::path& path) {
  Json json = {{"phases", phases_json(truth.phases)}};
  if (truth.tags) json["tags"] = tags_json(*truth.tags);
  if (truth.camera) json["camera"] = camera_json(*truth.camera);
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  const auto add_file = [&](const char* key, const fs::path& file) {
    if (!file.empty()) json[key] = fs::absolute(file).lexically_normal().lexically_relative(folder).string();
  };
  add_file("corners", truth.corners);
  add_file("target_poses", truth.target_poses);
  add_file("camera_poses", truth.camera_poses);
  add_file("clean_frames", truth.clean_frames);
  return json;
}

std::string truth_text(const GroundTruth& truth, const fs::path& path) {
  try {
    return truth_json(truth, path).dump(2) + '\n';
  } catch (const nlohmann::json::exception& error) {  // a name that isn't UTF-8
    throw usage_error(fmt::format("{}: cannot be written as JSON ({})", path.string(), error.what()));
  }
}

}  // namespace

void write_ground_truth(const fs::path& path, const GroundTruth& truth) {
  const std::string text = truth_text(truth, path);
  parse_ground_truth(text, path);  // whatever cannot be read back is not written
  write_file(path, text);
}

CornersWriter::CornersWriter(const fs::path& path) : name_(path.string()), file_(path) {
  file_.write("t_s,id,visible,x1,y1,x2,y2,x3,y3,x4,y4\n");
}

void CornersWriter::write(const TrueCorners& corners) {
  std::string line =
      fmt::format("{},{},{}", short_seconds(corners.t_us), corners.id, corners.visible ? 1 : 0);
  append_numbers(line, ',', corners.xy_px, name_);
  file_.write(line + '\n');
}

TrackWriter::TrackWriter(const fs::path& path)
    : name_(path.string()), file_(path), latest_us_(std::numeric_limits<std::int64_t>::min()) {}

void TrackWriter::write(const TrackPose& pose) {
  std::string line = short_seconds(pose.t_us);
  if (pose.t_us <= latest_us_) {
    throw Error(fmt::format("{}: a pose at {} s is not after the one before, at {} s", name_, line,
                            short_seconds(latest_us_)));
  }
  append_numbers(line, ' ', pose.position_m, name_);
  append_numbers(line, ' ', pose.quaternion_xyzw, name_);
  file_.write(line + '\n');
  latest_us_ = pose.t_us;
}

}  // namespace esi

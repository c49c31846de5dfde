#include "esi/pipeline/evaluation/loaded_truth.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/eval/tag_families.hpp"
#include "esi/io/picture_list.hpp"
#include "esi/io/truth_tables.hpp"

namespace esi {
namespace {

ExpectedTags expected_tags(const GroundTruth& truth, const EvalConfig& config, const std::string& name) {
  if (const auto given = config.judging.id_list(); !given.empty()) {
    require_tag_ids(config.detector.family, given);
    return {given};
  }
  if (!truth.tags) return {};
  const auto within_file = [&](auto check) {
    try {
      check();
    } catch (const Error& error) {
      throw usage_error(fmt::format("{}: {}", name, error.what()));
    }
  };
  within_file([&] { tag_family_info(truth.tags->family); });
  if (truth.tags->family != config.detector.family) {
    throw usage_error(
        fmt::format("{}: its tags are of the family {}, the detector looks for {}; use --family {}", name,
                    truth.tags->family, config.detector.family, truth.tags->family));
  }
  within_file([&] { require_tag_ids(truth.tags->family, truth.tags->ids); });
  return {truth.tags->ids};
}

/// Truth in pixels is in those of the whole sensor.
void refuse_region(const GroundTruth& truth, const EvalConfig& config, const std::string& name) {
  const bool has_pixels = !truth.corners.empty() || truth.camera || !truth.clean_frames.empty();
  if (!has_pixels || !config.frames.region()) return;
  throw usage_error(fmt::format(
      "{}: it has corners, a camera or clean frames, which are those of the whole sensor; leave out --roi",
      name));
}

}  // namespace

LoadedTruth load_truth(const std::filesystem::path& path, const EvalConfig& config) {
  LoadedTruth loaded;
  loaded.truth = read_ground_truth(path);
  refuse_region(loaded.truth, config, path.string());
  loaded.expected = expected_tags(loaded.truth, config, path.string());
  if (!loaded.truth.corners.empty()) {
    loaded.corner_rows = read_corners(loaded.truth.corners);
    loaded.corners.emplace(loaded.corner_rows);
  }
  if (config.judging.tracking) {
    if (!loaded.truth.camera_poses.empty()) loaded.camera_poses = read_track(loaded.truth.camera_poses);
    if (!loaded.truth.target_poses.empty()) loaded.target_poses = read_track(loaded.truth.target_poses);
  }
  if (config.judging.quality && !loaded.truth.clean_frames.empty()) {
    for (auto& picture : read_picture_list(loaded.truth.clean_frames)) {
      loaded.clean_frames[picture.t_us] = std::move(picture.file);
    }
  }
  return loaded;
}

}  // namespace esi

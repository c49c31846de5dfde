#pragma once

#include <cstdint>
#include <filesystem>

#include "esi/core/truth.hpp"
#include "esi/io/ground_truth.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {

/// Writes ground_truth.json; the truth's files stand in it relative to its folder. Throws a usage Error for
/// what read_ground_truth() would refuse, and an Error where the file cannot be written.
void write_ground_truth(const std::filesystem::path& path, const GroundTruth& truth);

/// corners.csv, row by row: t_s,id,visible,x1,y1,...,x4,y4. The file appears with finish().
class CornersWriter {
 public:
  explicit CornersWriter(const std::filesystem::path& path);

  /// Throws an Error for numbers that aren't finite.
  void write(const TrueCorners& corners);
  void finish() { file_.commit(); }

 private:
  std::string name_;
  OutputFile file_;
};

/// A track of poses, line by line: "t tx ty tz qx qy qz qw". The file appears with finish().
class TrackWriter {
 public:
  explicit TrackWriter(const std::filesystem::path& path);

  /// Throws an Error for numbers that aren't finite, and for times that don't rise.
  void write(const TrackPose& pose);
  void finish() { file_.commit(); }

 private:
  std::string name_;
  OutputFile file_;
  std::int64_t latest_us_;
};

}  // namespace esi

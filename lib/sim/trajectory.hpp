#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/core/phase.hpp"
#include "esi/sim/flight_options.hpp"
#include "esi/sim/timed_pose.hpp"

namespace esi {

/// How the camera moves over the board.
struct TrajectoryOptions {
  enum class Kind { flight, still, slide, rotation, poses };
  Kind kind = Kind::flight;
  double duration_s = 62.0;
  double height_m = 2.0;
  FlightOptions flight;
  double slide_m = 0.3;
  double slide_mps = 0.3;
  double rotation_deg_s = 30.0;
  std::string poses;                 ///< file of TUM lines; whoever opens files fills pose_list from it
  std::vector<TimedPose> pose_list;  ///< for Kind::poses; the first pose's time becomes 0

  void declare(OptionTable& table);
};

/// Where camera and board are at any time from 0 on. World: metres, z up, ground at z = 0. Camera and board:
/// x right, y down (in the image; on the board as its tags are read), z away from the viewer.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual std::int64_t duration_us() const = 0;
  virtual Pose camera(std::int64_t t_us) const = 0;
  virtual Pose board(std::int64_t t_us) const = 0;
  virtual std::vector<Phase> phases() const = 0;
  /// While the vehicle drives among obstacles.
  virtual Interval among_obstacles() const { return {0, duration_us()}; }
};

/// `seed` decides how a flight wanders. Throws a usage Error where `poses` has no list of at least 1 ms.
std::unique_ptr<Trajectory> make_trajectory(const TrajectoryOptions& options, std::int64_t seed);

/// Rotation of a camera or board seen from above, whose image's upper edge points to `heading_rad` (from the
/// world's x axis towards its y axis).
cv::Matx33d facing_down(double heading_rad);

/// The board lies this high, on the vehicle.
inline constexpr double kDeckHeight_m = 0.3;

}  // namespace esi

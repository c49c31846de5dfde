#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "esi/core/packet.hpp"
#include "esi/io/losses.hpp"

namespace esi {

/// A file's intensity frames, whichever datasets its layout keeps them in.
class Hdf5Images {
 public:
  virtual ~Hdf5Images() = default;

  /// When image `index` was taken, in seconds; NaN where its own time is damaged; nothing behind the last.
  /// Throws an Error where no more times can be read.
  virtual std::optional<double> seconds(std::uint64_t index) = 0;

  /// The image as CV_8UC1, or CV_8UC3 with blue first. Throws an Error where it cannot be decoded.
  virtual cv::Mat image(std::uint64_t index) = 0;
};

/// Hands out intensity frames beside the events, one image in memory at a time. Their damage is counted and
/// the first of it noted; it never stops the events.
class Hdf5FrameTrack {
 public:
  /// `size`, if given, is what an image must have. `notes` must outlive this.
  Hdf5FrameTrack(std::unique_ptr<Hdf5Images> images, std::optional<SensorSize> size,
                 std::vector<std::string>& notes)
      : images_(std::move(images)), size_(size), notes_(&notes) {}

  /// Frames that cannot be read at all, for this reason: only counted and noted.
  Hdf5FrameTrack(const std::string& reason, std::vector<std::string>& notes);

  /// Appends the next frames that were taken until t_us, at most four. Returns false when none was due.
  bool append_until(std::int64_t t_us, Packet& packet, Losses& losses);

  /// Reads the first images, as long as `go_on` says so, and does nothing with them.
  void try_out(const std::function<bool()>& go_on);

 private:
  std::optional<std::int64_t> next_time_us();
  void append_next(std::int64_t t_us, Packet& packet);
  void note_damage(const std::string& reason);

  std::unique_ptr<Hdf5Images> images_;  ///< none once no more can be had
  std::optional<SensorSize> size_;
  std::vector<std::string>* notes_;
  std::uint64_t next_ = 0;
  std::int64_t damaged_ = 0;  ///< not yet counted in the losses
  bool has_damage_ = false;
};

}  // namespace esi

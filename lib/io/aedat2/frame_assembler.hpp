#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"
#include "esi/io/aedat2/address.hpp"

namespace esi {

/// Puts the intensity frames of a DAVIS together from their single readings: of every pixel one after its
/// reset and one after the exposure (formats.md 2.3). Holds one frame.
class Aedat2FrameAssembler {
 public:
  explicit Aedat2FrameAssembler(SensorSize sensor) : sensor_(sensor) {}

  /// Takes a reading. Returns the frame that it completes: CV_16UC1 over the full 16 bits, row 0 at the top.
  std::optional<IntensityFrame> add(DavisAddress reading, std::int64_t t_us);

  /// How many frames were left out because readings of them are missing.
  std::int64_t incomplete() const { return incomplete_; }

  /// At the end of the recording: whether a frame was still to be completed.
  bool is_within_frame() const { return resets_ > 0; }

 private:
  /// The readings of one pixel, and for which frame, counted from 1, they are.
  struct Pixel {
    std::int64_t reset_frame = 0, signal_frame = 0;
    std::uint16_t reset = 0, signal = 0;
  };

  void add_reset(Pixel& pixel, DavisAddress reading, std::int64_t t_us);
  std::optional<IntensityFrame> add_signal(Pixel& pixel, DavisAddress reading, std::int64_t t_us);
  bool begins_frame(const Pixel& pixel, DavisAddress reading) const;
  IntensityFrame complete() const;
  void discard();
  void begin_frame();

  SensorSize sensor_;
  std::vector<Pixel> pixels_;             ///< row by row; allocated with the first reading
  std::int64_t frame_ = 1;                ///< that is being read
  std::size_t resets_ = 0, signals_ = 0;  ///< how many pixels of it were read
  DavisAddress last_reset_{0};
  std::int64_t first_reset_us_ = 0, last_reset_us_ = 0, first_signal_us_ = 0;
  bool is_global_shutter_ = false;  ///< all pixels were reset before the first signal was read
  bool is_discarded_told_ = false;  ///< the signals that come are of a frame that is counted as incomplete
  std::int64_t incomplete_ = 0;
};

}  // namespace esi

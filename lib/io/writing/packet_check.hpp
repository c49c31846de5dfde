#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "esi/core/packet.hpp"
#include "esi/io/writing/recording_writer.hpp"

namespace esi {

/// What every format asks of the packets of a recording, however they are cut.
class PacketCheck {
 public:
  /// Throws a usage Error for options that no format can hold. `name` is what messages call the recording.
  PacketCheck(const WriteOptions& options, std::string name);

  /// Throws an Error for events or frames that are out of order, at impossible times or outside the sensor,
  /// and for images of another size or type.
  void admit(const Packet& packet);

 private:
  void admit_event(const Event& event);
  void admit_frame(const IntensityFrame& frame);

  SensorSize size_;
  std::string name_;
  std::int64_t latest_us_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t latest_exposure_end_us_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace esi

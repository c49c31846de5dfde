#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/prophesee/evt_decoder.hpp"
#include "esi/io/rosbag/message.hpp"
#include "esi/io/rosbag/message_decoders.hpp"

namespace esi {

/// Decodes the messages of one event topic, one after the other, in pieces.
class RosEventDecoder {
 public:
  /// Begins a message, which must stay where it is until nothing is left. Returns why it can't be decoded, as
  /// a clause ("its events are encoded as ..."), empty where it can.
  std::string begin(const RosEvents& message);

  bool has_more() const { return !rest_.empty(); }
  /// Appends some of the message's events: up to 12288.
  void decode_some(std::vector<Event>& events);

  /// Whether the events' times are ROS times, as those of the images; else they are the camera's own.
  bool has_ros_time() const { return !std::holds_alternative<EvtDecoder>(decoder_); }
  /// Events before the first time word of EVT2 and EVT3: they have no time and are left out.
  std::int64_t events_without_time() const;

 private:
  using AnyDecoder = std::variant<DvsDecoder, LibcaerDecoder, LibcaerCmpDecoder, MonoDecoder, EvtDecoder>;

  std::optional<AnyDecoder> decoder_for(const RosEvents& message) const;

  AnyDecoder decoder_;
  std::string encoding_;
  std::size_t word_bytes_ = 1;
  std::span<const std::byte> rest_;
};

}  // namespace esi

#include "esi/io/rosbag/reader.hpp"

#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/io/rosbag/event_decoder.hpp"
#include "esi/io/rosbag/image.hpp"
#include "esi/io/rosbag/messages.hpp"

namespace esi {
namespace {

// So many images may come before the first message with events, which has the sensor's size.
constexpr std::size_t kMaxEarlyFrames = 64;

void move_losses(Losses& from, Losses& to) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(Damage::count_); ++i) {
    to.add(static_cast<Damage>(i), from.of(static_cast<Damage>(i)));
  }
  from = {};
}

class RosbagReader final : public FormatReader {
 public:
  RosbagReader(ByteWindow bytes, const std::optional<std::filesystem::path>& path, const ReadOptions& options)
      : sensor_(options.sensor_size()), messages_(std::move(bytes), options.stream) {
    header_.format = "rosbag";
    header_.has_packets = true;
    messages_.begin(path, early_losses_, header_.notes);
    while (encoding_.empty() && early_frames_.frames.size() < kMaxEarlyFrames &&
           next_message(early_frames_, early_losses_)) {
    }
    header_.layout = fmt::format("ROS bag, {} {}", messages_.topics().events(), encoding_);
    header_.has_intensity_frames = !messages_.topics().images().empty() && decoder_.has_ros_time();
  }

  const RecordingHeader& header() const override { return header_; }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t enough = packet.events.size() + kPacketEvents;
    const std::size_t frames_before = packet.frames.size();
    const std::size_t ends_before = packet.packet_ends_us.size();
    move_losses(early_losses_, losses);
    for (IntensityFrame& frame : early_frames_.frames) add_frame(std::move(frame), packet);
    early_frames_.clear();
    while (packet.events.size() < enough && packet.frames.size() == frames_before) {
      if (decoder_.has_more()) {
        decode_some(packet);
      } else if (!next_message(packet, losses)) {
        break;
      }
    }
    return packet.events.size() + kPacketEvents > enough || packet.frames.size() > frames_before ||
           packet.packet_ends_us.size() > ends_before;
  }

  std::optional<double> fraction_read() const override { return messages_.records().fraction_taken(); }

 private:
  /// Takes the bag's next message; false at the end.
  bool next_message(Packet& packet, Losses& losses) {
    const auto message = messages_.next(losses, header_.notes);
    if (!message) {
      tell_events_without_time();
    } else if (message->role == RosbagRole::images) {
      take_image(*message, packet, losses);
    } else {
      begin_events(*message, losses);
    }
    return message.has_value();
  }

  void begin_events(const RosbagMessage& message, Losses& losses) {
    const auto events = message.role == RosbagRole::event_arrays ? parse_event_array(message.data)
                                                                 : parse_event_packet(message.data);
    const std::string obstacle = events ? decoder_.begin(*events) : "it is damaged";
    if (!obstacle.empty()) {
      // The recording's first message tells what the others are like.
      if (events && encoding_.empty()) {
        throw Error(fmt::format("{}: the message at byte {} of {}: {}", messages_.records().name(),
                                message.position, messages_.topics().events(), obstacle));
      }
      add_corrupt(fmt::format("The message at byte {} is left out: {}.", message.position, obstacle), losses);
      return;
    }
    if (encoding_.empty()) {
      encoding_ = events->encoding;
      header_.sensor = events->sensor;
      if (!sensor_) sensor_ = events->sensor;
    }
  }

  void decode_some(Packet& packet) {
    const std::size_t before = packet.events.size();
    decoder_.decode_some(packet.events);
    if (packet.events.size() > before) message_end_us_ = packet.events.back().t_us + 1;
    if (decoder_.has_more() || !message_end_us_) return;
    packet.packet_ends_us.push_back(*message_end_us_);
    message_end_us_.reset();
  }

  void take_image(const RosbagMessage& message, Packet& packet, Losses& losses) {
    auto frame = decode_ros_image(message.data);
    if (frame) {
      add_frame(std::move(*frame), packet);
    } else {
      losses.add(Damage::unreadable_frame);
      if (std::exchange(unreadable_told_, true)) return;
      header_.notes.push_back(
          fmt::format("The image at byte {} is damaged, or neither grey nor 8-bit colour; it is left out.",
                      message.position));
    }
  }

  void add_frame(IntensityFrame frame, Packet& packet) {
    const cv::Size size = frame.image.size();
    const bool has_events = !encoding_.empty();
    const bool is_of_sensor = !sensor_ || SensorSize{size.width, size.height} == *sensor_;
    if (is_of_sensor && (!has_events || decoder_.has_ros_time())) {
      packet.frames.push_back(std::move(frame));
    } else if (!std::exchange(frames_told_, true)) {
      header_.notes.push_back(fmt::format("The images of {} are left out: {}.", messages_.topics().images(),
                                          is_of_sensor
                                              ? "they have ROS times, the events those of their camera"
                                              : "they are not of the events' sensor size"));
    }
  }

  void tell_events_without_time() {
    const std::int64_t events = decoder_.events_without_time();
    if (events == 0 || std::exchange(without_time_told_, true)) return;
    header_.notes.push_back(
        fmt::format("{} events before the first time word have no time and are left out.", events));
  }

  void add_corrupt(std::string note, Losses& losses) {
    losses.add(Damage::corrupt_packet);
    if (!std::exchange(corrupt_told_, true)) header_.notes.push_back(std::move(note));
  }

  RecordingHeader header_;
  std::optional<SensorSize> sensor_;  ///< as given, or as the first message has it
  RosbagMessages messages_;
  RosEventDecoder decoder_;
  std::string encoding_;  ///< of the first message with events; empty before it
  Packet early_frames_;   ///< of before that message
  Losses early_losses_;
  std::optional<std::int64_t> message_end_us_;  ///< of the message's events so far, half-open
  bool frames_told_ = false, unreadable_told_ = false, without_time_told_ = false, corrupt_told_ = false;
};

}  // namespace

bool looks_like_rosbag(std::span<const std::byte> head) {
  return head.size() >= kRosbagMagic.size() &&
         std::memcmp(head.data(), kRosbagMagic.data(), kRosbagMagic.size()) == 0;
}

std::unique_ptr<FormatReader> open_rosbag(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  bytes->skip(kRosbagMagic.size());
  std::optional<std::filesystem::path> path;
  if (bytes->file_bytes()) path = bytes->path();
  return std::make_unique<RosbagReader>(ByteWindow(std::move(bytes)), path, options);
}

}  // namespace esi

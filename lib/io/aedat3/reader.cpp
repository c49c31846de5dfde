#include "esi/io/aedat3/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "esi/core/error.hpp"
#include "esi/io/aedat3/frame.hpp"
#include "esi/io/aedat3/header.hpp"
#include "esi/io/aedat3/packets.hpp"
#include "esi/io/camera_chip.hpp"

namespace esi {
namespace {

RecordingHeader describe(const std::optional<Aedat3Source>& source, const ReadOptions& options) {
  RecordingHeader header;
  header.format = "aedat3";
  header.layout = "AEDAT 3.1, RAW";
  header.has_packets = true;
  if (source) {
    header.layout += ", " + source->name;
    header.sensor = source->size;
    header.has_intensity_frames = source->has_frames;
  }
  if (!options.chip.empty()) {
    const CameraChip& chip = require_camera_chip(options.chip);
    header.sensor = chip.size;
    header.has_intensity_frames = chip.is_davis;
  }
  if (!header.sensor) {
    header.notes.push_back(fmt::format(
        "The header names no known chip; --chip ({}) or --size gives the sensor size.", camera_chip_names()));
  }
  return header;
}

class Aedat3Reader final : public FormatReader {
 public:
  Aedat3Reader(ByteWindow bytes, const std::optional<Aedat3Source>& source, const ReadOptions& options)
      : header_(describe(source, options)),
        sensor_(options.sensor_size()),
        packets_(std::move(bytes), source ? std::optional(source->id) : std::nullopt) {
    if (!sensor_) sensor_ = header_.sensor;
  }

  const RecordingHeader& header() const override { return header_; }
  std::optional<double> fraction_read() const override { return packets_.fraction_taken(); }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t enough = packet.events.size() + kPacketEvents;
    const std::size_t frames_before = packet.frames.size();
    const std::size_t ends_before = packet.packet_ends_us.size();
    while (packet.events.size() < enough && packet.frames.size() == frames_before) {
      if (events_left_ > 0) {
        take_events(packet, enough - packet.events.size(), losses);
      } else if (!begin_packet(losses)) {
        break;
      }
    }
    return packet.events.size() + kPacketEvents > enough || packet.frames.size() > frames_before ||
           packet.packet_ends_us.size() > ends_before;
  }

 private:
  bool begin_packet(Losses& losses) {
    const auto next = packets_.next(losses, header_.notes);
    if (!next) return false;
    current_ = *next;
    events_left_ = current_.events;
    has_events_ = false;
    return true;
  }

  void take_events(Packet& packet, std::size_t at_most, Losses& losses) {
    const bool is_frame = current_.type == Aedat3Packet::kFrame;
    const std::size_t wanted = is_frame ? 1 : std::min(at_most, events_left_);
    const auto stored = packets_.take_events(current_, wanted, losses, header_.notes);
    if (stored.empty()) {
      events_left_ = 0;
      return;
    }
    events_left_ -= stored.size() / current_.event_bytes;
    if (is_frame) {
      take_frame(stored, packet, losses);
    } else {
      take_polarity(stored, packet.events);
      if (events_left_ == 0 && has_events_) packet.packet_ends_us.push_back(last_us_ + 1);
    }
  }

  void take_polarity(std::span<const std::byte> stored, std::vector<Event>& events);
  void take_frame(std::span<const std::byte> stored, Packet& packet, Losses& losses);

  RecordingHeader header_;
  std::optional<SensorSize> sensor_;  ///< where frames are placed, if it is known
  Aedat3Packets packets_;
  Aedat3Packet current_;
  std::size_t events_left_ = 0;  ///< of the current packet
  bool has_events_ = false;      ///< whether the current packet had a valid event yet
  std::int64_t last_us_ = 0;     ///< of the last valid event
  bool corrupt_told_ = false;
};

void Aedat3Reader::take_polarity(std::span<const std::byte> stored, std::vector<Event>& events) {
  const std::size_t before = events.size();
  events.resize(before + stored.size() / current_.event_bytes);
  Event* next = events.data() + before;
  for (std::size_t i = 0; i < stored.size(); i += current_.event_bytes) {
    std::uint32_t data;
    std::int32_t time;
    std::memcpy(&data, stored.data() + i, sizeof data);
    std::memcpy(&time, stored.data() + i + sizeof data, sizeof time);
    *next = {current_.t_us(time), static_cast<std::uint16_t>(data >> 17U),
             static_cast<std::uint16_t>(data >> 2U & 0x7FFF), (data & 2U) != 0};
    next += data & 1U;  // an event that the camera marked as invalid is overwritten
  }
  events.resize(static_cast<std::size_t>(next - events.data()));
  if (events.size() == before) return;
  has_events_ = true;
  last_us_ = events.back().t_us;
}

void Aedat3Reader::take_frame(std::span<const std::byte> stored, Packet& packet, Losses& losses) {
  auto decoded = decode_aedat3_frame(current_, stored, sensor_);
  if (decoded.frame) packet.frames.push_back(std::move(*decoded.frame));
  if (!decoded.is_damaged) return;
  losses.add(Damage::corrupt_packet);
  if (corrupt_told_) return;
  corrupt_told_ = true;
  header_.notes.push_back(
      fmt::format("A frame in the packet at byte {} is damaged and left out.", current_.position));
}

}  // namespace

bool looks_like_aedat3(std::span<const std::byte> head) {
  return std::string_view(reinterpret_cast<const char*>(head.data()), head.size()).starts_with(kAedat3Magic);
}

std::unique_ptr<FormatReader> open_aedat3(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  ByteWindow window(std::move(bytes));
  const Aedat3Header header = read_aedat3_header(window);
  const auto source = select_aedat3_source(header, options, window.name());
  if (window.peek(1).empty()) {
    throw Error(fmt::format("{}: the file ends with its header, at byte {}: it holds no events",
                            window.name(), window.position()));
  }
  return std::make_unique<Aedat3Reader>(std::move(window), source, options);
}

}  // namespace esi

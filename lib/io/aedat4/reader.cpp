#include "esi/io/aedat4/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "esi/io/aedat4/events.hpp"
#include "esi/io/aedat4/flatbuffer_unpacker.hpp"
#include "esi/io/aedat4/frame.hpp"
#include "esi/io/aedat4/header.hpp"
#include "esi/io/aedat4/packets.hpp"
#include "esi/io/aedat4/selection.hpp"

namespace esi {
namespace {

std::vector<int> ids_of(const Aedat4Selection& streams) {
  std::vector<int> ids{streams.events.id};
  if (streams.frames) ids.push_back(streams.frames->id);
  return ids;
}

RecordingHeader describe(const Aedat4Header& file, const Aedat4Selection& streams) {
  RecordingHeader header;
  header.format = "aedat4";
  header.layout = "AEDAT 4, " + file.compression;
  header.sensor = streams.events.size;
  header.has_packets = true;
  header.has_intensity_frames = streams.frames.has_value();
  if (!header.sensor) {
    header.notes.push_back(
        fmt::format("The header has no possible sensor size for stream {}.", streams.events.id));
  }
  const auto is_frames = [](const Aedat4Stream& stream) { return stream.type == "FRME"; };
  if (!streams.frames && std::any_of(file.streams.begin(), file.streams.end(), is_frames)) {
    header.notes.push_back(
        fmt::format("The intensity frames are of another camera or size than the events and "
                    "are left out; the streams are {}.",
                    file.streams_text()));
  }
  return header;
}

class Aedat4Reader final : public FormatReader {
 public:
  /// `sensor` is where frames are placed, if it is known.
  Aedat4Reader(ByteWindow bytes, const Aedat4Header& file, const Aedat4Selection& streams,
               std::optional<SensorSize> sensor)
      : header_(describe(file, streams)),
        events_stream_(streams.events.id),
        sensor_(sensor),
        table_position_(file.data_table_position),
        packets_(std::move(bytes), file, ids_of(streams)),
        unpacker_(file.codec) {}

  const RecordingHeader& header() const override { return header_; }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t enough = packet.events.size() + kPacketEvents;
    const std::size_t frames_before = packet.frames.size();
    const std::size_t ends_before = packet.packet_ends_us.size();
    while (packet.events.size() < enough && packet.frames.size() == frames_before) {
      if (!pending_.empty()) {
        move_pending(packet, enough - packet.events.size(), losses);
      } else if (!next_packet(packet, losses)) {
        break;
      }
    }
    return packet.events.size() + kPacketEvents > enough || packet.frames.size() > frames_before ||
           packet.packet_ends_us.size() > ends_before;
  }

  std::optional<double> fraction_read() const override {
    if (table_position_ <= 0) return std::nullopt;
    return std::min(1.0, static_cast<double>(packets_.position()) / static_cast<double>(table_position_));
  }

 private:
  /// Decodes the file's next packet; false at the end.
  bool next_packet(Packet& packet, Losses& losses) {
    const auto stored = packets_.next(losses, header_.notes);
    if (!stored) return false;
    const auto flatbuffer = unpacker_.unpack(stored->payload);
    const bool is_decoded = flatbuffer && (stored->stream == events_stream_ ? begin_events(*flatbuffer)
                                                                            : add_frame(*flatbuffer, packet));
    if (!is_decoded) add_corrupt(stored->position, losses);
    return true;
  }

  bool begin_events(std::span<const std::byte> flatbuffer) {
    const auto events = Aedat4Events::in(flatbuffer);
    if (events) pending_ = *events;
    if (!pending_.empty()) pending_end_us_ = pending_.end_us();
    return events.has_value();
  }

  bool add_frame(std::span<const std::byte> flatbuffer, Packet& packet) {
    auto frame = decode_aedat4_frame(flatbuffer, sensor_);
    if (frame) packet.frames.push_back(std::move(*frame));
    return frame.has_value();
  }

  void move_pending(Packet& packet, std::size_t count, Losses& losses) {
    losses.add(Drop::outside_sensor, static_cast<std::int64_t>(pending_.move_to(packet.events, count)));
    if (pending_.empty()) packet.packet_ends_us.push_back(pending_end_us_);
  }

  void add_corrupt(std::size_t position, Losses& losses) {
    losses.add(Damage::corrupt_packet);
    if (corrupt_told_) return;
    corrupt_told_ = true;
    header_.notes.push_back(fmt::format("The packet at byte {} is damaged and left out.", position));
  }

  RecordingHeader header_;
  int events_stream_;
  std::optional<SensorSize> sensor_;
  std::int64_t table_position_;
  Aedat4Packets packets_;
  FlatbufferUnpacker unpacker_;
  Aedat4Events pending_;  ///< of the packet that was unpacked last, not yet handed out
  std::int64_t pending_end_us_ = 0;
  bool corrupt_told_ = false;
};

}  // namespace

bool looks_like_aedat4(std::span<const std::byte> head) {
  return head.size() >= kAedat4Magic.size() &&
         std::memcmp(head.data(), kAedat4Magic.data(), kAedat4Magic.size()) == 0;
}

std::unique_ptr<FormatReader> open_aedat4(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  ByteWindow window(std::move(bytes));
  const Aedat4Header file = read_aedat4_header(window);
  const Aedat4Selection streams = select_aedat4_streams(file, options.stream, window.name());
  const auto given_size = options.sensor_size();
  return std::make_unique<Aedat4Reader>(std::move(window), file, streams,
                                        given_size ? given_size : streams.events.size);
}

}  // namespace esi

#include "esi/io/aedat2/reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/io/aedat2/address.hpp"
#include "esi/io/aedat2/frame_assembler.hpp"
#include "esi/io/aedat2/header.hpp"

namespace esi {
namespace {

RecordingHeader describe(const Aedat2Camera& camera) {
  RecordingHeader header;
  header.format = "aedat2";
  header.layout = fmt::format("AEDAT 2.0, {}", camera.chip.name);
  header.sensor = camera.sensor;
  header.has_intensity_frames = camera.chip.is_davis;
  header.notes = camera.notes;
  return header;
}

class Aedat2Reader final : public FormatReader {
 public:
  Aedat2Reader(ByteWindow bytes, const Aedat2Camera& camera)
      : header_(describe(camera)),
        bytes_(std::move(bytes)),
        is_davis_(camera.chip.is_davis),
        right_(camera.sensor.width_px - 1),
        bottom_(camera.sensor.height_px - 1),
        frames_(camera.sensor) {}

  const RecordingHeader& header() const override { return header_; }
  std::optional<double> fraction_read() const override { return bytes_.fraction_taken(); }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t events_before = packet.events.size();
    const std::size_t frames_before = packet.frames.size();
    while (packet.events.size() == events_before && packet.frames.size() == frames_before) {
      const auto records = take_records(losses);
      if (records.empty()) return false;
      const std::size_t position = bytes_.position() - records.size();
      const std::size_t outside =
          is_davis_ ? take_davis(records, packet) : take_dvs128(records, packet.events);
      losses.add(Drop::outside_sensor, static_cast<std::int64_t>(outside));
      tell_oddities(position);
    }
    return true;
  }

 private:
  std::span<const std::byte> take_records(Losses& losses);
  std::size_t take_dvs128(std::span<const std::byte> records, std::vector<Event>& events);
  std::size_t take_davis(std::span<const std::byte> records, Packet& packet);
  Event* put(Event* target, std::int64_t t_us, int from_right, int from_bottom, bool on) const;
  void tell_oddities(std::size_t position);
  void tell_incomplete_frame(std::size_t position);

  RecordingHeader header_;
  ByteWindow bytes_;
  bool is_davis_;
  int right_, bottom_;  ///< the last column and row
  Aedat2Clock clock_;
  Aedat2FrameAssembler frames_;
  bool wrap_told_ = false;
  bool incomplete_frame_told_ = false;
};

/// The next records that are there without waiting; empty at the end.
std::span<const std::byte> Aedat2Reader::take_records(Losses& losses) {
  const std::size_t at_least = bytes_.peek(kAedat2RecordBytes).size();
  if (at_least == kAedat2RecordBytes) {
    const std::size_t records = std::min(kPacketEvents, bytes_.available() / kAedat2RecordBytes);
    return bytes_.take(records * kAedat2RecordBytes);
  }
  if (at_least > 0) {
    losses.add(Damage::cut_packet);
    header_.notes.push_back(fmt::format("The file ends within the record at byte {}.", bytes_.position()));
    bytes_.skip(at_least);
  }
  if (frames_.is_within_frame()) tell_incomplete_frame(bytes_.position());
  return {};
}

/// Writes an event, if it lies on the sensor; returns where the next one goes.
Event* Aedat2Reader::put(Event* target, std::int64_t t_us, int from_right, int from_bottom, bool on) const {
  const int x = right_ - from_right;
  const int y = bottom_ - from_bottom;
  if (x < 0 || y < 0) return target;
  *target = {t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), on};
  return target + 1;
}

/// Returns how many events lie outside the sensor.
std::size_t Aedat2Reader::take_dvs128(std::span<const std::byte> records, std::vector<Event>& events) {
  const std::size_t before = events.size();
  events.resize(before + records.size() / kAedat2RecordBytes);
  Event* next = events.data() + before;
  std::size_t outside = 0;
  for (const std::byte *r = records.data(), *end = r + records.size(); r != end; r += kAedat2RecordBytes) {
    const Dvs128Address address{aedat2_word(r)};
    const std::int64_t t_us = clock_.accept(aedat2_word(r + 4));
    if (address.fits() && address.is_external()) continue;
    Event* const behind = address.fits() ? put(next, t_us, address.x(), address.y(), address.on()) : next;
    outside += behind == next ? 1U : 0U;
    next = behind;
  }
  events.resize(static_cast<std::size_t>(next - events.data()));
  return outside;
}

/// Returns how many events lie outside the sensor.
std::size_t Aedat2Reader::take_davis(std::span<const std::byte> records, Packet& packet) {
  const std::size_t before = packet.events.size();
  packet.events.resize(before + records.size() / kAedat2RecordBytes);
  Event* next = packet.events.data() + before;
  std::size_t outside = 0;
  for (const std::byte *r = records.data(), *end = r + records.size(); r != end; r += kAedat2RecordBytes) {
    const DavisAddress address{aedat2_word(r)};
    const std::int64_t t_us = clock_.accept(aedat2_word(r + 4));
    if (address.is_event()) {
      Event* const behind = put(next, t_us, address.x(), address.y(), address.on());
      outside += behind == next ? 1U : 0U;
      next = behind;
    } else if (auto frame = frames_.add(address, t_us)) {
      packet.frames.push_back(std::move(*frame));
    }
  }
  packet.events.resize(static_cast<std::size_t>(next - packet.events.data()));
  return outside;
}

/// `position` is the first byte of the records that were taken last.
void Aedat2Reader::tell_oddities(std::size_t position) {
  if (clock_.has_wrapped() && !wrap_told_) {
    wrap_told_ = true;
    header_.notes.push_back(
        fmt::format("The 32-bit clock wraps (first behind byte {}): its times are unwrapped.", position));
  }
  if (frames_.incomplete() > 0) tell_incomplete_frame(position);
}

void Aedat2Reader::tell_incomplete_frame(std::size_t position) {
  if (incomplete_frame_told_) return;
  incomplete_frame_told_ = true;
  header_.notes.push_back(fmt::format(
      "Intensity frames of which readings are missing (first about byte {}) are left out.", position));
}

bool starts_with(std::span<const std::byte> head, std::string_view magic) {
  return std::string_view(reinterpret_cast<const char*>(head.data()), head.size()).starts_with(magic);
}

}  // namespace

bool looks_like_aedat2(std::span<const std::byte> head) {
  return starts_with(head, kAedat2Magic) || starts_with(head, kAedat1Magic);
}

std::unique_ptr<FormatReader> open_aedat2(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  ByteWindow window(std::move(bytes));
  const Aedat2Camera camera = read_aedat2_header(window, options);
  return std::make_unique<Aedat2Reader>(std::move(window), camera);
}

}  // namespace esi

#include "esi/io/writing/aedat4_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/io/writing/aedat4_encoding.hpp"
#include "esi/io/writing/lz4_frame.hpp"

namespace esi {
namespace {

constexpr std::int64_t kPacket_us = 10000;
constexpr std::size_t kMaxPacketEvents = std::size_t{1} << 16;
/// Of the table; more would not fit into a FlatBuffer of 2 GB. Two days of packets of 10 ms.
constexpr std::size_t kMaxPackets = std::size_t{1} << 24;

void require_possible(const std::filesystem::path& path, SensorSize size) {
  constexpr int max_side_px = std::numeric_limits<std::int16_t>::max();
  if (size.width_px <= max_side_px && size.height_px <= max_side_px) return;
  throw usage_error(fmt::format("{}: AEDAT 4 holds sensors up to {} px a side, not {}", path.string(),
                                max_side_px, to_string(size)));
}

class Aedat4Writer final : public RecordingWriter {
 public:
  Aedat4Writer(const std::filesystem::path& path, const WriteOptions& options)
      : name_(path.string()), options_(options), file_(path) {
    append(encode_aedat4_header(options_, -1));
  }

  /// Each frame comes behind the events that were before its end.
  void write(const Packet& packet) override {
    auto event = packet.events.begin();
    for (const IntensityFrame& frame : packet.frames) {
      const auto end = std::partition_point(event, packet.events.end(),
                                            [&](const Event& e) { return e.t_us < frame.exposure.end_us; });
      add_events({event, end});
      flush_events();
      write_frame(frame);
      event = end;
    }
    add_events({event, packet.events.end()});
  }

  void finish() override {
    flush_events();
    const auto table_position = static_cast<std::int64_t>(bytes_);
    append(lz4_frame(encode_aedat4_table(table_)));
    file_.write_at(0, encode_aedat4_header(options_, table_position));
    file_.commit();
  }

 private:
  void add_events(std::span<const Event> events) {
    for (const Event& event : events) {
      const bool is_full = pending_.size() == kMaxPacketEvents ||
                           (!pending_.empty() && event.t_us - pending_.front().t_us >= kPacket_us);
      if (is_full) flush_events();
      pending_.push_back(event);
    }
  }

  void flush_events() {
    if (pending_.empty()) return;
    write_packet(encode_aedat4_events(pending_, options_.t_offset_us),
                 {.stream = kAedat4EventStream,
                  .elements = static_cast<std::int64_t>(pending_.size()),
                  .begin_us = pending_.front().t_us + options_.t_offset_us,
                  .end_us = pending_.back().t_us + options_.t_offset_us});
    pending_.clear();
  }

  void write_frame(const IntensityFrame& frame) {
    write_packet(encode_aedat4_frame(frame, options_.t_offset_us),
                 {.stream = kAedat4FrameStream,
                  .elements = 1,
                  .begin_us = frame.exposure.begin_us + options_.t_offset_us,
                  .end_us = frame.exposure.end_us + options_.t_offset_us});
  }

  /// Fills in what the row does not yet say of the packet's place.
  void write_packet(const Bytes& buffer, Aedat4TableRow row) {
    if (table_.size() == kMaxPackets) {
      throw Error(fmt::format("{}: AEDAT 4 cannot list more than {} packets; write a shorter recording",
                              name_, kMaxPackets));
    }
    const Bytes payload = lz4_frame(buffer);
    row.size = static_cast<std::int32_t>(payload.size());
    append(encode_aedat4_packet_head(row.stream, row.size));
    row.byte_offset = static_cast<std::int64_t>(bytes_);
    append(payload);
    table_.push_back(row);
  }

  void append(const Bytes& bytes) {
    file_.write(std::span(bytes));
    bytes_ += bytes.size();
  }

  std::string name_;
  WriteOptions options_;
  OutputFile file_;
  std::size_t bytes_ = 0;       ///< written so far
  std::vector<Event> pending_;  ///< of the packet that isn't full yet
  std::vector<Aedat4TableRow> table_;
};

}  // namespace

std::unique_ptr<RecordingWriter> open_aedat4_writer(const std::filesystem::path& path,
                                                    const WriteOptions& options) {
  require_possible(path, options.size);
  return std::make_unique<Aedat4Writer>(path, options);
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace esi::test {

/// As the header of an AEDAT 4 file numbers them.
enum class Aedat4Compression : std::int32_t { none, lz4, lz4_high, zstd, zstd_high };

/// An event as it is stored.
struct Aedat4Event {
  std::int64_t t_us = 0;
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::uint8_t polarity = 0;
};

/// A frame as it is stored; what is left out is not in the file.
struct Aedat4Frame {
  std::int64_t t_us = 0;
  std::optional<std::int64_t> start_of_exposure_us, end_of_exposure_us;
  std::int8_t format = 0;
  std::int16_t width_px = 0, height_px = 0, x_px = 0, y_px = 0;
  std::string pixels;
  std::optional<std::int64_t> exposure_us;
};

/// Size-prefixed FlatBuffers, laid out by hand. The events' own data begin at a multiple of `align` bytes,
/// 8 or 4, and for 4 at none of 8.
std::string aedat4_event_buffer(const std::vector<Aedat4Event>& events, std::size_t align = 8);
std::string aedat4_frame_buffer(const Aedat4Frame& frame);

/// `size` is "346x260" or empty: without sizes.
std::string aedat4_stream_xml(int id, std::string_view type, std::string_view size,
                              std::string_view source = "DAVIS346_1");
/// The whole XML around such streams.
std::string aedat4_xml(std::string_view streams);

std::string aedat4_compressed(std::string_view bytes, Aedat4Compression compression);

/// An AEDAT 4 file that grows packet by packet.
class Aedat4File {
 public:
  Aedat4File(Aedat4Compression compression, std::string xml)
      : compression_(compression), xml_(std::move(xml)) {}

  /// Compresses and appends a packet.
  void add(std::int32_t stream, std::string_view buffer);
  /// Appends a packet whose payload is as it is, with a size that may be wrong.
  void add_stored(std::int32_t stream, std::string_view payload, std::int32_t size);
  void add_stored(std::int32_t stream, std::string_view payload) {
    add_stored(stream, payload, static_cast<std::int32_t>(payload.size()));
  }

  /// Where the next packet will begin; where the table of packets is in the end.
  std::size_t position() const { return header(0).size() + packets_.size(); }

  /// The file with its table, and the table's position as the header gives it.
  std::string bytes(std::optional<std::int64_t> table_position = {}) const;
  /// The file without its table.
  std::string bytes_without_table(std::int64_t table_position) const;

 private:
  std::string header(std::int64_t table_position) const;

  Aedat4Compression compression_;
  std::string xml_;
  std::string packets_;
};

/// Events of one stream, 0, of a 346x260 sensor: what most tests want.
Aedat4File aedat4_event_file(Aedat4Compression compression, std::string_view size = "346x260");

/// "#!AER-DAT4.0" and the header.
std::string aedat4_header(std::int32_t compression, std::int64_t table_position, std::string_view xml);

}  // namespace esi::test

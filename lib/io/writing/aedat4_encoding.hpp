#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/frame.hpp"
#include "esi/io/writing/recording_writer.hpp"

namespace esi {

// Which of a file's streams is which.
inline constexpr std::int32_t kAedat4EventStream = 0;
inline constexpr std::int32_t kAedat4FrameStream = 1;

/// A packet's row in the file's table.
struct Aedat4TableRow {
  std::int64_t byte_offset = 0;  ///< of the payload, behind the packet's head
  std::int32_t stream = 0;
  std::int32_t size = 0;  ///< of the payload
  std::int64_t elements = 0;
  std::int64_t begin_us = 0, end_us = 0;  ///< first and last event, or exposure
};

using Bytes = std::vector<std::byte>;

/// The magic bytes and the header of a file of LZ4 packets: of the same size for any position of the table
/// (-1: not there yet).
Bytes encode_aedat4_header(const WriteOptions& options, std::int64_t table_position);

// Size-prefixed FlatBuffers, to be compressed. Times get options' offset added.
Bytes encode_aedat4_events(std::span<const Event> events, std::int64_t t_offset_us);
Bytes encode_aedat4_frame(const IntensityFrame& frame, std::int64_t t_offset_us);
Bytes encode_aedat4_table(std::span<const Aedat4TableRow> rows);

/// A packet's head, which stands before the payload.
Bytes encode_aedat4_packet_head(std::int32_t stream, std::int32_t size);

}  // namespace esi

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace esi {

/// What a record of a bag is.
enum class RosbagOp : std::uint8_t {
  message = 2,
  bag_header = 3,
  index_data = 4,
  chunk = 5,
  chunk_info = 6,
  connection = 7,
};

/// What stands in front of a record's data.
struct RosbagRecord {
  RosbagOp op{};
  std::uint32_t connection = 0;  ///< of messages and connections: the connection's number
  std::uint64_t index_pos = 0;   ///< of the bag header: where the index begins; 0: it was never written
  std::string compression;       ///< of chunks
  std::size_t data_bytes = 0;
  std::size_t position = 0;  ///< of the record in the file, or of the compressed chunk that it lies in
};

/// From a record's header fields, without data_bytes and position. Empty where they are damaged or lack what
/// the record needs.
std::optional<RosbagRecord> parse_rosbag_record(std::span<const std::byte> header);

/// The topic that a connection carries.
struct RosbagConnection {
  std::string topic;
  std::string type;  ///< "dvs_msgs/EventArray"
};

/// From a connection record's data. Empty where it is damaged or lacks topic or type.
std::optional<RosbagConnection> parse_rosbag_connection(std::span<const std::byte> data);

}  // namespace esi

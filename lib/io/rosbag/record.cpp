#include "esi/io/rosbag/record.hpp"

#include <algorithm>

#include "esi/io/rosbag/fields.hpp"

namespace esi {
namespace {

// ROS names are short; a longer one is damage, and would fill memory or a message.
constexpr std::size_t kMaxNameBytes = 256;

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= kMaxNameBytes &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

std::optional<RosbagRecord> parse_rosbag_record(std::span<const std::byte> header) {
  RosbagRecord record;
  std::optional<std::uint8_t> op;
  std::optional<std::uint32_t> connection;
  RosbagFields fields(header);
  while (const auto field = fields.next()) {
    if (field->name == "op") op = field->number<std::uint8_t>();
    if (field->name == "conn") connection = field->number<std::uint32_t>();
    if (field->name == "index_pos") record.index_pos = field->number<std::uint64_t>().value_or(0);
    if (field->name == "compression") record.compression = field->text().substr(0, kMaxNameBytes);
  }
  if (fields.is_damaged() || !op) return std::nullopt;
  record.op = static_cast<RosbagOp>(*op);
  const bool has_connection = record.op == RosbagOp::message || record.op == RosbagOp::connection;
  if (has_connection && !connection) return std::nullopt;
  record.connection = connection.value_or(0);
  return record;
}

std::optional<RosbagConnection> parse_rosbag_connection(std::span<const std::byte> data) {
  RosbagConnection connection;
  RosbagFields fields(data);
  while (const auto field = fields.next()) {
    if (field->name == "topic" && is_name(field->text())) connection.topic = field->text();
    if (field->name == "type" && is_name(field->text())) connection.type = field->text();
  }
  if (fields.is_damaged() || connection.topic.empty() || connection.type.empty()) return std::nullopt;
  return connection;
}

}  // namespace esi

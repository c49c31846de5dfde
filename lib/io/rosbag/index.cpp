#include "esi/io/rosbag/index.hpp"

#include "esi/io/rosbag/records.hpp"

namespace esi {
namespace {

// A robot has some hundred.
constexpr std::size_t kMaxConnections = 65536;

}  // namespace

std::optional<std::vector<RosbagConnection>> read_rosbag_index(const std::filesystem::path& path,
                                                               std::uint64_t index_pos) {
  std::error_code error;
  if (index_pos == 0 || !std::filesystem::is_regular_file(path, error)) return std::nullopt;
  if (index_pos > std::filesystem::file_size(path, error) || error) return std::nullopt;
  auto source = std::make_unique<ByteSource>(path);
  if (source->skip(index_pos) < index_pos) return std::nullopt;

  RosbagRecords records{ByteWindow(std::move(source))};
  std::vector<RosbagConnection> connections;
  Losses losses;
  std::vector<std::string> notes;
  while (const auto record = records.next(losses, notes)) {
    if (record->op == RosbagOp::chunk_info) return connections;  // they all stand before it
    if (record->op != RosbagOp::connection || connections.size() >= kMaxConnections) return std::nullopt;
    const auto data = records.take_data(losses, notes);
    auto connection = data ? parse_rosbag_connection(*data) : std::nullopt;
    if (!connection) return std::nullopt;
    connections.push_back(std::move(*connection));
  }
  return std::nullopt;
}

}  // namespace esi

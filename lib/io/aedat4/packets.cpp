#include "esi/io/aedat4/packets.hpp"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "esi/io/aedat4/flatbuffer_unpacker.hpp"

namespace esi {
namespace {

constexpr std::size_t kHeadBytes = 8;
// The table has no head of its own: it begins as a compressed frame or, uncompressed, as a FlatBuffer does,
// with its size, an offset, and its identifier.
constexpr std::size_t kTableStartBytes = 12;
constexpr std::int32_t kLz4Magic = 0x184D2204;
constexpr std::int32_t kZstdMagic = static_cast<std::int32_t>(0xFD2FB528);

std::int32_t int32_at(std::span<const std::byte> bytes, std::size_t offset) {
  return flatbuffers::ReadScalar<std::int32_t>(bytes.data() + offset);
}

bool looks_like_table(std::span<const std::byte> start) {
  const std::int32_t magic = int32_at(start, 0);
  const bool is_uncompressed_table =
      start.size() == kTableStartBytes && std::memcmp(start.data() + kHeadBytes, "FTAB", 4) == 0;
  return magic == kLz4Magic || magic == kZstdMagic || is_uncompressed_table;
}

bool is_possible(std::int32_t size) {
  return size >= 0 && static_cast<std::size_t>(size) <= FlatbufferUnpacker::kMaxBytes;
}

}  // namespace

std::optional<Aedat4Packet> Aedat4Packets::next(Losses& losses, Notes& notes) {
  while (const auto head = next_head(losses, notes)) {
    const std::size_t position = bytes_.position() - kHeadBytes;
    const auto size = static_cast<std::size_t>(head->size);
    if (size == 0) continue;
    const bool is_wanted = std::find(wanted_.begin(), wanted_.end(), head->stream) != wanted_.end();
    const auto payload = is_wanted ? bytes_.take(size) : std::span<const std::byte>();
    if ((is_wanted ? payload.size() : bytes_.skip(size)) < size) {
      at_end_ = true;
      losses.add(Damage::cut_packet);
      notes.push_back(fmt::format("The file ends within the packet at byte {}.", position));
    } else if (is_wanted) {
      return Aedat4Packet{head->stream, position, payload};
    }
  }
  return std::nullopt;
}

std::optional<Aedat4Packets::Head> Aedat4Packets::next_head(Losses& losses, Notes& notes) {
  if (at_end_) return std::nullopt;
  if (header_.data_table_position < static_cast<std::int64_t>(bytes_.position())) tell_table(losses, notes);
  const auto start = bytes_.peek(kTableStartBytes);
  if (start.size() < kHeadBytes) {
    at_end_ = true;
    end_of_file(start.size(), losses, notes);
    return std::nullopt;
  }
  if (looks_like_table(start)) {
    at_end_ = true;
    if (!is_at_table()) tell_table(losses, notes);
    return std::nullopt;
  }
  const Head head{int32_at(start, 0), int32_at(start, 4)};
  at_end_ = ends_here(head, losses, notes);
  if (at_end_) return std::nullopt;
  bytes_.skip(kHeadBytes);
  return head;
}

/// Counts, once, that the file's table is not where the header says.
void Aedat4Packets::tell_table(Losses& losses, Notes& notes) {
  if (table_told_) return;
  table_told_ = true;
  losses.add(Damage::missing_table);
  if (header_.data_table_position == -1) {
    notes.emplace_back(
        "The recorder was stopped before it wrote the file's table of packets; the packets were "
        "read one after the other up to the file's end.");
  } else {
    notes.push_back(
        fmt::format("The file's table of packets is not at byte {} as the header says; the packets "
                    "were read one after the other.",
                    header_.data_table_position));
  }
}

bool Aedat4Packets::is_at_table() const {
  return header_.data_table_position == static_cast<std::int64_t>(bytes_.position());
}

/// Whether no further packet can be found: what stands here is no packet.
bool Aedat4Packets::ends_here(Head head, Losses& losses, Notes& notes) {
  const bool is_declared = header_.find(head.stream) != nullptr;
  if (is_declared && is_possible(head.size)) return false;
  if (is_at_table()) {
    notes.push_back(fmt::format("The file's table of packets, at byte {}, is damaged; it is not needed.",
                                bytes_.position()));
    return true;
  }
  losses.add(Damage::corrupt_packet);
  if (!is_possible(head.size)) {
    notes.push_back(
        fmt::format("The packet at byte {} claims {} bytes, which can't be; reading stopped there.",
                    bytes_.position(), head.size));
    return true;
  }
  if (!undeclared_told_) {
    undeclared_told_ = true;
    notes.push_back(fmt::format("The packet at byte {} is of stream {}, which the header does not declare.",
                                bytes_.position(), head.stream));
  }
  return false;
}

void Aedat4Packets::end_of_file(std::size_t bytes_left, Losses& losses, Notes& notes) {
  const std::int64_t table = header_.data_table_position;
  const bool is_short = table > static_cast<std::int64_t>(bytes_.position());
  if (!is_short && (bytes_left == 0 || is_at_table())) return;
  losses.add(Damage::cut_packet);
  notes.push_back(is_short ? fmt::format("The file ends at byte {}, before its table of packets at byte {}.",
                                         bytes_.position() + bytes_left, table)
                           : fmt::format("The file ends within the packet at byte {}.", bytes_.position()));
}

}  // namespace esi

#include "esi/io/rosbag/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr std::size_t kLengthBytes = 4;
// A header's fields are numbers, and a connection's topic.
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;
// Of a message or connection: 80 million events.
constexpr std::size_t kMaxDataBytes = std::size_t{1} << 30;
constexpr std::uint32_t kLz4Magic = 0x184D2204;

std::uint32_t length_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t length;
  std::memcpy(&length, bytes.data() + offset, sizeof length);
  return length;
}

}  // namespace

std::optional<RosbagRecord> RosbagRecords::next(Losses& losses, Notes& notes) {
  while (!at_end_) {
    const std::size_t to_skip = std::exchange(data_left_, 0);
    if (skip(to_skip) < to_skip) {
      end_of_file(true, losses, notes);
      break;
    }
    auto record = take_head(losses, notes);
    if (!record) continue;
    if (record->op == RosbagOp::chunk) {
      enter_chunk(*record, losses, notes);
      continue;
    }
    if (record->op == RosbagOp::bag_header) index_pos_ = record->index_pos;
    is_in_index_ = is_in_index_ || (record->position == index_pos_ && record->op == RosbagOp::connection);
    return record;
  }
  return std::nullopt;
}

/// Takes what stands before a record's data; empty where there is none, or none that can be read.
std::optional<RosbagRecord> RosbagRecords::take_head(Losses& losses, Notes& notes) {
  const std::size_t position = position_of_next();
  const auto start = peek(kLengthBytes);
  const std::size_t header_bytes = start.size() < kLengthBytes ? 0 : length_at(start, 0);
  if (room() < 2 * kLengthBytes || header_bytes > std::min(kMaxHeaderBytes, room() - 2 * kLengthBytes)) {
    bad_lengths(losses, notes);
    return std::nullopt;
  }
  const std::size_t head_bytes = header_bytes + 2 * kLengthBytes;
  const auto head = peek(head_bytes);
  if (head.size() < head_bytes) {
    // Where the index begins, all messages have been read.
    end_of_file(!head.empty() && position != index_pos_, losses, notes);
    return std::nullopt;
  }
  const std::size_t data_bytes = length_at(head, kLengthBytes + header_bytes);
  if (data_bytes > room() - head_bytes) {
    bad_lengths(losses, notes);
    return std::nullopt;
  }
  auto record = parse_rosbag_record(head.subspan(kLengthBytes, header_bytes));
  skip(head_bytes);
  data_left_ = data_bytes;
  if (!record) {
    corrupt(fmt::format("The record at byte {} is damaged and left out.", position), losses, notes);
    return std::nullopt;
  }
  record->data_bytes = data_bytes;
  record->position = position;
  return record;
}

std::optional<std::span<const std::byte>> RosbagRecords::take_data(Losses& losses, Notes& notes) {
  const std::size_t bytes = std::exchange(data_left_, 0);
  if (bytes > kMaxDataBytes) {
    data_left_ = bytes;
    corrupt(fmt::format("The record before byte {} claims {} bytes, which can't be; it is left out.",
                        position_of_next(), bytes),
            losses, notes);
    return std::nullopt;
  }
  if (is_unpacked()) {
    const auto data = unpacked_.first(bytes);
    unpacked_ = unpacked_.subspan(bytes);
    return data;
  }
  const auto data = bytes_.take(bytes);
  stored_left_ -= std::min(stored_left_, bytes);
  if (data.size() == bytes) return data;
  end_of_file(true, losses, notes);
  return std::nullopt;
}

void RosbagRecords::enter_chunk(const RosbagRecord& chunk, Losses& losses, Notes& notes) {
  if (is_in_chunk()) {
    corrupt(fmt::format("There is a chunk within the chunk at byte {}; it is left out.", chunk_position_),
            losses, notes);
    return;
  }
  chunk_position_ = chunk.position;
  if (chunk.compression == "none") {
    // A killed recorder leaves a chunk of length 0: its records then follow as if there were no chunk.
    stored_left_ = std::exchange(data_left_, 0);
  } else if (chunk.compression == "lz4") {
    enter_lz4_chunk(chunk, losses, notes);
  } else if (chunk.compression == "bz2") {
    throw Error(fmt::format(
        "{}: the chunk at byte {} is compressed with bz2, which can't be read; unpack the bag first "
        "(rosbag decompress)",
        name(), chunk.position));
  } else {
    corrupt(fmt::format("The chunk at byte {} is compressed in an unknown way and left out.", chunk.position),
            losses, notes);
  }
}

void RosbagRecords::enter_lz4_chunk(const RosbagRecord& chunk, Losses& losses, Notes& notes) {
  const auto start = peek(kLengthBytes);
  // A killed recorder leaves length 0, and a frame that goes on to the end of the file.
  const bool is_unfinished =
      data_left_ == 0 && start.size() == kLengthBytes && length_at(start, 0) == kLz4Magic;
  const std::size_t bytes = is_unfinished ? RosbagChunk::kMaxBytes : data_left_;
  if (bytes > RosbagChunk::kMaxBytes) {
    corrupt(fmt::format("The chunk at byte {} claims {} bytes, which can't be; it is left out.",
                        chunk.position, bytes),
            losses, notes);
    return;
  }
  data_left_ = 0;
  if (bytes == 0) return;
  const auto frame = bytes_.take(bytes);
  if (frame.size() < bytes) {
    is_chunk_cut_ = true;
    unpacked_ = chunk_.decompress_cut(frame);
    return;
  }
  const auto unpacked = chunk_.decompress(frame);
  if (unpacked) {
    unpacked_ = *unpacked;
  } else {
    corrupt(fmt::format("The chunk at byte {} is damaged and left out.", chunk.position), losses, notes);
  }
}

/// Where a record's lengths can't be, nothing tells where the next one begins, up to the end of the chunk.
void RosbagRecords::bad_lengths(Losses& losses, Notes& notes) {
  const std::size_t position = position_of_next();
  if (is_unpacked() && is_chunk_cut_) {
    end_of_file(true, losses, notes);
    return;
  }
  if (is_in_chunk()) {
    corrupt(fmt::format("The record at byte {} has lengths that can't be; the rest of its chunk is left out.",
                        position),
            losses, notes);
    data_left_ = room();
    return;
  }
  corrupt_told_ = false;  // this one matters more than those before it
  corrupt(fmt::format("The record at byte {} has lengths that can't be; reading stopped there.", position),
          losses, notes);
  at_end_ = true;
}

void RosbagRecords::corrupt(std::string note, Losses& losses, Notes& notes) {
  losses.add(Damage::corrupt_packet);
  if (!std::exchange(corrupt_told_, true)) notes.push_back(std::move(note));
}

void RosbagRecords::end_of_file(bool is_within_record, Losses& losses, Notes& notes) {
  at_end_ = true;
  unpacked_ = {};
  const std::size_t end = bytes_.position() + bytes_.peek(kMaxHeaderBytes).size();
  const bool is_short = is_within_record || is_chunk_cut_ || stored_left_ > 0 || index_pos_ > end;
  if (is_in_index_ || !is_short) return;
  losses.add(Damage::cut_packet);
  notes.push_back(fmt::format("The file ends within a record or before its index, at byte {}.", end));
}

std::size_t RosbagRecords::room() const {
  if (is_unpacked()) return unpacked_.size();
  return stored_left_ > 0 ? stored_left_ : std::numeric_limits<std::size_t>::max();
}

std::span<const std::byte> RosbagRecords::peek(std::size_t bytes) {
  return is_unpacked() ? unpacked_.first(std::min(bytes, unpacked_.size())) : bytes_.peek(bytes);
}

std::size_t RosbagRecords::skip(std::size_t bytes) {
  if (is_unpacked()) {
    const std::size_t skipped = std::min(bytes, unpacked_.size());
    unpacked_ = unpacked_.subspan(skipped);
    return skipped;
  }
  stored_left_ -= std::min(stored_left_, bytes);
  return bytes_.skip(bytes);
}

}  // namespace esi

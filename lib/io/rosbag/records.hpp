#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/io/byte_window.hpp"
#include "esi/io/losses.hpp"
#include "esi/io/rosbag/chunk.hpp"
#include "esi/io/rosbag/record.hpp"

namespace esi {

inline constexpr std::string_view kRosbagMagic = "#ROSBAG V2.0\n";

/// Walks a bag's records forward, those in chunks as if there were no chunks. The index is not needed.
class RosbagRecords {
 public:
  using Notes = std::vector<std::string>;

  /// `bytes` stand behind the magic bytes.
  explicit RosbagRecords(ByteWindow bytes) : bytes_(std::move(bytes)) {}

  /// The next record that is no chunk; data of the last one that were not taken are passed over. Empty at the
  /// end. What is damaged is counted and told in `notes`. Throws an Error at a chunk compressed with bz2.
  std::optional<RosbagRecord> next(Losses& losses, Notes& notes);

  /// The data of the record that `next` gave last; valid until the next call. Empty where the file ends
  /// before, or where it is larger than any message may be.
  std::optional<std::span<const std::byte>> take_data(Losses& losses, Notes& notes);

  const std::string& name() const { return bytes_.name(); }
  /// How much of the file has been read, as ByteWindow.
  std::optional<double> fraction_taken() const { return bytes_.fraction_taken(); }

 private:
  std::optional<RosbagRecord> take_head(Losses& losses, Notes& notes);
  void enter_chunk(const RosbagRecord& chunk, Losses& losses, Notes& notes);
  void enter_lz4_chunk(const RosbagRecord& chunk, Losses& losses, Notes& notes);
  void bad_lengths(Losses& losses, Notes& notes);
  void corrupt(std::string note, Losses& losses, Notes& notes);
  void end_of_file(bool is_within_record, Losses& losses, Notes& notes);

  bool is_unpacked() const { return !unpacked_.empty(); }
  bool is_in_chunk() const { return is_unpacked() || stored_left_ > 0; }
  std::size_t room() const;
  std::size_t position_of_next() const { return is_unpacked() ? chunk_position_ : bytes_.position(); }
  std::span<const std::byte> peek(std::size_t bytes);
  std::size_t skip(std::size_t bytes);

  ByteWindow bytes_;
  RosbagChunk chunk_;
  std::span<const std::byte> unpacked_;  ///< of the LZ4 chunk that is walked: what is left
  std::size_t stored_left_ = 0;          ///< of the uncompressed chunk that is walked: bytes left
  std::size_t chunk_position_ = 0;
  std::size_t data_left_ = 0;  ///< of the last record, not yet taken
  std::uint64_t index_pos_ = 0;
  bool is_chunk_cut_ = false;  ///< the file ends within an LZ4 chunk
  bool is_in_index_ = false;
  bool at_end_ = false;
  bool corrupt_told_ = false;
};

}  // namespace esi

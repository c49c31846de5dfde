#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "esi/io/aedat4/header.hpp"
#include "esi/io/byte_window.hpp"
#include "esi/io/losses.hpp"

namespace esi {

/// A packet as it stands in the file.
struct Aedat4Packet {
  int stream = 0;
  std::size_t position = 0;            ///< of its first byte in the file
  std::span<const std::byte> payload;  ///< compressed; valid until the next call
};

/// Walks an AEDAT 4 file's packets forward, from behind the header to the file's table of packets or, where
/// that is missing, to the file's end.
class Aedat4Packets {
 public:
  /// Packets of other streams than those of the ids `wanted` are passed over.
  Aedat4Packets(ByteWindow bytes, Aedat4Header header, std::vector<int> wanted)
      : bytes_(std::move(bytes)), header_(std::move(header)), wanted_(std::move(wanted)) {}

  /// Empty at the end. What is damaged is counted, and told in `notes`.
  std::optional<Aedat4Packet> next(Losses& losses, std::vector<std::string>& notes);

  const std::string& name() const { return bytes_.name(); }
  std::size_t position() const { return bytes_.position(); }

 private:
  struct Head {
    int stream;
    std::int32_t size;
  };
  using Notes = std::vector<std::string>;

  std::optional<Head> next_head(Losses& losses, Notes& notes);
  void tell_table(Losses& losses, Notes& notes);
  bool is_at_table() const;
  bool ends_here(Head head, Losses& losses, Notes& notes);
  void end_of_file(std::size_t bytes_left, Losses& losses, Notes& notes);

  ByteWindow bytes_;
  Aedat4Header header_;
  std::vector<int> wanted_;
  bool at_end_ = false;
  bool table_told_ = false, undeclared_told_ = false;
};

}  // namespace esi

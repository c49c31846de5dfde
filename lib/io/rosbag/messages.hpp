#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/io/losses.hpp"
#include "esi/io/rosbag/index.hpp"
#include "esi/io/rosbag/records.hpp"
#include "esi/io/rosbag/topics.hpp"

namespace esi {

/// A message of one of the topics that are read.
struct RosbagMessage {
  RosbagRole role = RosbagRole::other;
  std::size_t position = 0;         ///< as RosbagRecord's
  std::span<const std::byte> data;  ///< valid until the next call
};

/// The messages of a bag's event topic and of its camera's images, in the order of the file.
class RosbagMessages {
 public:
  /// `bytes` stand behind the magic bytes; `wanted` is as in RosbagTopics.
  RosbagMessages(ByteWindow bytes, std::string wanted)
      : records_(std::move(bytes)), topics_(std::move(wanted), records_.name()) {}

  /// Takes the bag header and, where `path` is that of a regular file, chooses among the index's connections.
  /// Throws what RosbagTopics::choose throws.
  void begin(const std::optional<std::filesystem::path>& path, Losses& losses,
             std::vector<std::string>& notes);

  /// Empty at the end. Throws what RosbagTopics::require and RosbagRecords throw.
  std::optional<RosbagMessage> next(Losses& losses, std::vector<std::string>& notes);

  const RosbagTopics& topics() const { return topics_; }
  const RosbagRecords& records() const { return records_; }

 private:
  using Notes = std::vector<std::string>;

  void meet_connection(const RosbagRecord& record, Losses& losses, Notes& notes);
  void tell_choice(Notes& notes);
  void add_corrupt(std::string note, Losses& losses, Notes& notes);

  RosbagRecords records_;
  RosbagTopics topics_;
  bool has_index_ = false;
  bool choice_told_ = false, further_told_ = false, corrupt_told_ = false;
};

}  // namespace esi

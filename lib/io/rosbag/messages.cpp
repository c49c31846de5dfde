#include "esi/io/rosbag/messages.hpp"

#include <fmt/format.h>

#include <utility>

namespace esi {

void RosbagMessages::begin(const std::optional<std::filesystem::path>& path, Losses& losses, Notes& notes) {
  const auto first = records_.next(losses, notes);
  const bool is_bag_header = first && first->op == RosbagOp::bag_header;
  const std::uint64_t index_pos = is_bag_header ? first->index_pos : 0;
  const auto index = path ? read_rosbag_index(*path, index_pos) : std::nullopt;
  has_index_ = index.has_value();
  if (index) {
    topics_.choose(*index);
  } else if (path) {
    losses.add(Damage::missing_table);
    notes.emplace_back(index_pos == 0
                           ? "The recorder was stopped before it wrote the bag's index; the records "
                             "were read one after the other."
                           : "The bag's index is missing or damaged; the records were read one after "
                             "the other.");
  }
}

std::optional<RosbagMessage> RosbagMessages::next(Losses& losses, Notes& notes) {
  while (const auto record = records_.next(losses, notes)) {
    if (record->op == RosbagOp::connection) meet_connection(*record, losses, notes);
    if (record->op != RosbagOp::message) continue;
    const RosbagRole* const role = topics_.role_of(record->connection);
    if (role == nullptr) {
      add_corrupt(fmt::format("The message at byte {} is of connection {}, which nothing declares before it.",
                              record->position, record->connection),
                  losses, notes);
    } else if (*role != RosbagRole::other) {
      const auto data = records_.take_data(losses, notes);
      if (data) return RosbagMessage{*role, record->position, *data};
    }
  }
  topics_.require();
  return std::nullopt;
}

void RosbagMessages::meet_connection(const RosbagRecord& record, Losses& losses, Notes& notes) {
  const auto data = records_.take_data(losses, notes);
  if (!data) return;
  const auto connection = parse_rosbag_connection(*data);
  if (connection) {
    topics_.meet(record.connection, *connection);
    if (!has_index_ && !topics_.is_asked_for()) tell_choice(notes);
  } else {
    add_corrupt(fmt::format("The connection at byte {} is damaged and left out.", record.position), losses,
                notes);
  }
}

/// Without the index the topic is chosen before all are known.
void RosbagMessages::tell_choice(Notes& notes) {
  if (!topics_.events().empty() && !std::exchange(choice_told_, true)) {
    notes.push_back(fmt::format("The events of topic {} are read, the first one met.", topics_.events()));
  }
  if (topics_.has_further_event_topics() && !std::exchange(further_told_, true)) {
    notes.push_back(fmt::format("There are further event topics; --stream chooses among {}.",
                                topics_.event_topics_text()));
  }
}

void RosbagMessages::add_corrupt(std::string note, Losses& losses, Notes& notes) {
  losses.add(Damage::corrupt_packet);
  if (!std::exchange(corrupt_told_, true)) notes.push_back(std::move(note));
}

}  // namespace esi

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "esi/io/rosbag/record.hpp"

namespace esi {

/// What is done with a connection's messages.
enum class RosbagRole { other, event_arrays, event_packets, images };

/// Which of a bag's topics are read: one with events, and the images of the same camera.
class RosbagTopics {
 public:
  /// `wanted` is the event topic to read; empty: the only one. `name` is what messages call the bag.
  RosbagTopics(std::string wanted, std::string name) : wanted_(std::move(wanted)), name_(std::move(name)) {}

  /// Chooses among all connections of the bag, where they are known beforehand. Throws what `require` throws,
  /// and a usage Error that lists the event topics when there are several and none is wanted.
  void choose(const std::vector<RosbagConnection>& all);

  /// A connection that is met on the way. Where nothing was chosen yet, the first fitting topics are.
  void meet(std::uint32_t id, const RosbagConnection& connection);

  /// Throws where no event topic was chosen: an Error that lists the topics, or a usage Error that lists the
  /// event topics where the wanted one is not there.
  void require() const;

  /// How messages of a connection are read; empty where none of that number was met.
  const RosbagRole* role_of(std::uint32_t id) const;

  const std::string& events() const { return events_; }
  const std::string& images() const { return images_; }  ///< empty: none
  /// Whether the event topic is the one that was asked for.
  bool is_asked_for() const { return !wanted_.empty(); }
  /// Event topics that were met beside the chosen one.
  bool has_further_event_topics() const { return event_topics_.size() > 1; }
  std::string event_topics_text() const;

 private:
  void see(const RosbagConnection& connection);
  bool is_image_topic(const RosbagConnection& connection) const;

  std::string wanted_, name_;
  std::string events_, images_;
  std::vector<std::string> event_topics_, other_topics_;  ///< those that messages list
  std::map<std::uint32_t, RosbagRole> roles_;
};

}  // namespace esi

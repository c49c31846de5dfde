#include "esi/io/rosbag/topics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {
namespace {

// So many topics are listed in a message, and so many connections are told apart.
constexpr std::size_t kMaxListed = 32;
constexpr std::size_t kMaxConnections = 65536;

RosbagRole role_of_type(std::string_view type) {
  if (type == "dvs_msgs/EventArray") return RosbagRole::event_arrays;
  if (type == "event_camera_msgs/EventPacket" || type == "event_array_msgs/EventArray") {
    return RosbagRole::event_packets;
  }
  return type == "sensor_msgs/Image" ? RosbagRole::images : RosbagRole::other;
}

bool is_events(const RosbagConnection& connection) {
  const RosbagRole role = role_of_type(connection.type);
  return role == RosbagRole::event_arrays || role == RosbagRole::event_packets;
}

/// "/davis/left/events": "/davis/left/"
std::string_view camera_of(std::string_view topic) { return topic.substr(0, topic.rfind('/') + 1); }

void list(std::vector<std::string>& topics, const std::string& text) {
  if (topics.size() < kMaxListed && std::find(topics.begin(), topics.end(), text) == topics.end()) {
    topics.push_back(text);
  }
}

std::string joined(const std::vector<std::string>& topics) {
  return fmt::format("{}", fmt::join(topics, ", "));
}

}  // namespace

void RosbagTopics::see(const RosbagConnection& connection) {
  if (is_events(connection)) {
    list(event_topics_, connection.topic);
    if (events_.empty() && (wanted_.empty() || wanted_ == connection.topic)) events_ = connection.topic;
  } else {
    list(other_topics_, fmt::format("{} ({})", connection.topic, connection.type));
  }
}

bool RosbagTopics::is_image_topic(const RosbagConnection& connection) const {
  return role_of_type(connection.type) == RosbagRole::images && !events_.empty() &&
         camera_of(connection.topic) == camera_of(events_);
}

void RosbagTopics::choose(const std::vector<RosbagConnection>& all) {
  for (const RosbagConnection& connection : all) see(connection);
  require();
  if (wanted_.empty() && has_further_event_topics()) {
    throw usage_error(fmt::format("{}: there are several event topics; choose one with --stream: {}", name_,
                                  event_topics_text()));
  }
  // The camera's own picture, rather than one that was made of it.
  for (const RosbagConnection& connection : all) {
    const bool is_raw = connection.topic.ends_with("/image_raw");
    if (is_image_topic(connection) && (images_.empty() || is_raw)) images_ = connection.topic;
  }
}

void RosbagTopics::meet(std::uint32_t id, const RosbagConnection& connection) {
  see(connection);
  if (images_.empty() && is_image_topic(connection)) images_ = connection.topic;
  const bool is_read = connection.topic == events_ || connection.topic == images_;
  if (roles_.size() >= kMaxConnections && !is_read) return;
  roles_[id] = is_read ? role_of_type(connection.type) : RosbagRole::other;
}

void RosbagTopics::require() const {
  if (!events_.empty()) return;
  if (!wanted_.empty() && !event_topics_.empty()) {
    throw usage_error(fmt::format("{}: '{}' is none of its event topics; give --stream one of: {}", name_,
                                  wanted_, event_topics_text()));
  }
  if (other_topics_.empty() && event_topics_.empty()) {
    throw Error(
        fmt::format("{}: no topic can be found in it; the file is empty or damaged, copy it again", name_));
  }
  throw Error(fmt::format(
      "{}: there is no event topic (dvs_msgs/EventArray, event_camera_msgs/EventPacket); its topics are {}",
      name_, joined(other_topics_)));
}

const RosbagRole* RosbagTopics::role_of(std::uint32_t id) const {
  const auto found = roles_.find(id);
  return found == roles_.end() ? nullptr : &found->second;
}

std::string RosbagTopics::event_topics_text() const { return joined(event_topics_); }

}  // namespace esi

// Whatever is done to a bag: events, or an Error. The sanitizers watch.
#include <catch2/catch.hpp>
#include <random>

#include "io/rosbag/read_rosbag.hpp"

namespace esi::test {
namespace {

/// Three chunks with events, images and an unread topic. `ends` gets where each message ends, and how many
/// events there are up to it.
std::string small_bag(const std::string& compression,
                      std::vector<std::pair<std::size_t, std::size_t>>* ends) {
  const std::string connections = rosbag_connection(0, kEvents, kDvsType) +
                                  rosbag_connection(1, "/dvs/image_raw", kImageType) +
                                  rosbag_connection(2, "/dvs/imu", "sensor_msgs/Imu");
  RosImage image;
  image.width = image.row_bytes = 5;
  image.height = 4;
  image.pixels = std::string(20, '\x42');
  const std::size_t begin = rosbag_file_without_index("").size();
  const std::size_t head = rosbag_chunk("none", "").size();
  std::string records;
  for (int i = 0; i < 3; ++i) {
    const auto first = some_events(1000 + 1000 * i, 20), second = some_events(1500 + 1000 * i, 10);
    std::string chunk = connections + rosbag_message(0, dvs_event_array(std::span(first)));
    const auto events = static_cast<std::size_t>(30 * i);
    if (ends != nullptr) ends->emplace_back(begin + records.size() + head + chunk.size(), events + 20);
    chunk += rosbag_message(1, ros_image(image)) + rosbag_message(2, "samples") +
             rosbag_message(0, dvs_event_array(std::span(second)));
    if (ends != nullptr) ends->emplace_back(begin + records.size() + head + chunk.size(), events + 30);
    records += rosbag_chunk(compression, chunk);
  }
  return rosbag_file(records, connections);
}

}  // namespace

TEST_CASE("a bag cut after any byte gives all whole messages before the cut") {
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  const std::string whole = small_bag("none", &ends);
  const std::vector<Event> events = read_rosbag(whole).all.events;
  REQUIRE(events.size() == 90);
  const TempFolder folder;
  const auto path = folder.write("cut.bag", whole);
  const std::size_t index = ends.back().first;
  for (std::size_t length = whole.size() - 1; length >= 13;
       length -= length > 4200 || length < 4000 ? 1 : 7) {
    CAPTURE(length);
    std::filesystem::resize_file(path, length);
    std::size_t expected = 0;
    for (const auto& [end, count] : ends) {
      if (length >= end) expected = count;
    }
    try {
      const FormatReading cut = read_with(open_rosbag, path);
      REQUIRE(cut.all.events.size() == expected);
      REQUIRE(std::equal(cut.all.events.begin(), cut.all.events.end(), events.begin()));
      if (length < index) REQUIRE(cut.losses.text() == "1 cut_packet, 1 missing_table");
      if (length > index) REQUIRE_FALSE(cut.losses.any());
    } catch (const Error& error) {
      REQUIRE(expected == 0);
      REQUIRE(std::string(error.what()).starts_with(path.string()));
    }
  }
}

TEST_CASE("a bag of lz4 chunks cut after any byte gives the events before the cut") {
  const std::string whole = small_bag("lz4", nullptr);
  const std::vector<Event> events = read_rosbag(whole).all.events;
  REQUIRE(events.size() == 90);
  const TempFolder folder;
  const auto path = folder.write("cut.bag", whole);
  std::size_t before = events.size();
  for (std::size_t length = whole.size() - 1; length > 4200; --length) {
    CAPTURE(length);
    std::filesystem::resize_file(path, length);
    try {
      const FormatReading cut = read_with(open_rosbag, path);
      REQUIRE(cut.all.events.size() <= before);
      REQUIRE(std::equal(cut.all.events.begin(), cut.all.events.end(), events.begin()));
      if (cut.all.events.size() < events.size()) REQUIRE(cut.losses.of(Damage::cut_packet) == 1);
      REQUIRE(cut.losses.of(Damage::corrupt_packet) == 0);
      before = cut.all.events.size();
    } catch (const Error& error) {
      CAPTURE(error.what());
      REQUIRE(length < 5000);  // within the first chunk, which is one block of lz4
      before = 0;
    }
  }
  CHECK(before == 0);
}

TEST_CASE("random damage to a bag gives events or an Error") {
  const std::string compression = GENERATE("none", "lz4");
  const std::string whole = small_bag(compression, nullptr);
  const std::size_t begin = rosbag_file_without_index("").size();
  const TempFolder folder;
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    // The bag header is mostly padding.
    const std::size_t first = below(6) == 0 ? 0 : begin;
    const std::size_t end = first == 0 ? 120 : bytes.size();
    for (std::size_t n = 1 + below(6); n > 0; --n)
      bytes[first + below(end - first)] = static_cast<char>(random());
    if (below(8) == 0) bytes.resize(13 + below(bytes.size() - 13));
    try {
      const FormatReading reading = read_with(open_rosbag, folder.write("damaged.bag", bytes));
      REQUIRE(reading.all.events.size() <= 5000);
      REQUIRE(reading.all.frames.size() <= 3);
      REQUIRE(reading.header.notes.size() <= 10);
      ++read;
    } catch (const Error&) {
      ++refused;
    }
  }
  CHECK(read > 500);
  CHECK(refused > 20);
}

}  // namespace esi::test

#include <chrono>
#include <map>
#include <thread>

#include "esi/io/format_reader.hpp"
#include "io/writing/writer_fixtures.hpp"

using esi::Event;
using esi::Packet;
using esi::test::Content;
using esi::test::kSensor;
using esi::test::TempFolder;
using esi::test::write_recording;

namespace {

std::vector<Event> random_events(std::size_t count, int gap_us, unsigned seed) {
  return esi::test::random_events({0, 0, kSensor.width_px, kSensor.height_px}, count, gap_us, seed);
}

std::vector<Event> events_at(std::int64_t t_us, std::size_t count) {
  std::vector<Event> events = random_events(count, 0, 5);
  for (Event& event : events) event.t_us = t_us;
  return events;
}

struct EventCase {
  std::string name;
  std::vector<Event> events;
};

const std::vector<EventCase>& event_cases() {
  static const std::vector<EventCase> cases = {
      {"corners of the sensor",
       {{0, 0, 0, true}, {1, 345, 0, false}, {1, 0, 259, true}, {999999, 345, 259, false}}},
      {"one event", {{1234567, 7, 9, true}}},
      {"dense", random_events(20000, 1, 1)},
      {"sparse, over half an hour", random_events(1000, 2000000, 2)},
      {"just below, at and above milliseconds",
       {{999, 1, 1, true},
        {1000, 2, 2, false},
        {1001, 3, 3, true},
        {2000, 4, 4, false},
        {9999, 5, 5, true},
        {10000, 6, 6, false},
        {10999, 7, 7, true},
        {20001, 8, 8, true}}},
      {"more events at one time than a packet or a chunk holds", events_at(5000, 140000)},
  };
  return cases;
}

std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      contents[entry.path().lexically_relative(folder).string()] = esi::test::content_of(entry.path());
    }
  }
  return contents;
}

}  // namespace

TEST_CASE("Events come back from every format exactly as they were written") {
  const std::string name = GENERATE("a.h5", "a.HDF5", "a.aedat4", "a.txt");
  for (const EventCase& row : event_cases()) {
    INFO(name << ", " << row.name);
    const TempFolder folder;
    write_recording(folder / name, {row.events, {}});
    CHECK(esi::test::names_in(folder.path()) == std::vector<std::string>{name});
    CHECK((esi::test::read_back(folder / name).events == row.events));
  }
}

TEST_CASE("A million events come back from every format exactly as they were written") {
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  const TempFolder folder;
  const std::vector<Event> events = random_events(1000000, 3, 3);
  write_recording(folder / name, {events, {}});
  CHECK((esi::test::read_back(folder / name).events == events));
}

TEST_CASE("A reader adds the time offset to what was written") {
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  const std::int64_t offset_us = GENERATE(1'650'000'000'123'456, -2'000'001);
  const TempFolder folder;
  std::vector<Event> events = random_events(3000, 1000, 4);
  write_recording(folder / name, {events, {}}, {kSensor, offset_us, "camera"});
  for (Event& event : events) event.t_us += offset_us;
  CHECK((esi::test::read_back(folder / name).events == events));
}

TEST_CASE("A recording without any event is a whole file") {
  const std::string name = GENERATE("a.h5", "a.aedat4");
  const TempFolder folder;
  write_recording(folder / name, {});
  CHECK(esi::test::read_back(folder / name).events.empty());
}

TEST_CASE("Frames come back from AEDAT 4 with their exposures and every grey level") {
  // An exposure from 0 on or before it is a case of its own: readers take a start of 0 as absent.
  const std::int64_t first_us = GENERATE(-5000, 0, 3000);
  const std::int64_t offset_us = GENERATE(0, 1'650'000'000'123'456);
  const TempFolder folder;
  Content content{random_events(5000, 100, 6), esi::test::noise_frames(first_us, 12)};
  content.frames.push_back({{700000, 700000}, esi::test::noise(99, kSensor.width_px, kSensor.height_px)});
  content.frames.push_back({{710000, 720000}, cv::Mat1w(260, 346, std::uint16_t{0xABCD})});
  const cv::Mat wide = esi::test::noise(7, 400, 300);
  content.frames.push_back({{715000, 730000}, wide(cv::Rect(10, 20, 346, 260))});
  write_recording(folder / "a.aedat4", content, {kSensor, offset_us, "camera"});
  for (Event& event : content.events) event.t_us += offset_us;
  for (esi::IntensityFrame& frame : content.frames) {
    frame.exposure = {frame.exposure.begin_us + offset_us, frame.exposure.end_us + offset_us};
  }
  const Content found = esi::test::read_back(folder / "a.aedat4");
  CHECK((found.events == content.events));
  CHECK(found.frames.size() == content.frames.size());
  CHECK(esi::test::same_frames(found.frames, content.frames));
}

TEST_CASE("Frames come back from RPG text at the middle of their exposures, with every grey level") {
  const std::int64_t offset_us = GENERATE(0, 3'000'001);
  const TempFolder folder;
  const Content content{random_events(20000, 100, 6), esi::test::noise_frames(3000, 12)};
  write_recording(folder / "events.txt", content, {kSensor, offset_us, ""});
  auto expected = content.frames;
  for (esi::IntensityFrame& frame : expected) {
    const std::int64_t middle_us = frame.exposure.begin_us + 5000 + offset_us;
    frame.exposure = {middle_us, middle_us};
  }
  CHECK(esi::test::same_frames(esi::test::read_back(folder / "events.txt").frames, expected));
}

TEST_CASE("In an AEDAT 4 file a frame stands behind the events before its end, and before all others") {
  const TempFolder folder;
  const Content content{random_events(5000, 100, 6), esi::test::noise_frames(3000, 12)};
  write_recording(folder / "a.aedat4", content);
  const auto reader = esi::open_reader(folder / "a.aedat4", {});
  Packet packet;
  esi::Losses losses;
  std::vector<Event> before;
  std::size_t frames = 0;
  while (reader->read(packet, losses)) {  // which ends a packet at each frame
    before.insert(before.end(), packet.events.begin(), packet.events.end());
    for (const esi::IntensityFrame& frame : packet.frames) {
      ++frames;
      const auto is_earlier = [&](const Event& e) { return e.t_us < frame.exposure.end_us; };
      CHECK(before.size() == static_cast<std::size_t>(
                                 std::count_if(content.events.begin(), content.events.end(), is_earlier)));
    }
    packet.clear();
  }
  CHECK(frames == 12);
}

TEST_CASE("The same recording gives the same bytes a second later") {
  const TempFolder folder;
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  Content content{random_events(100000, 5, 8), {}};
  if (esi::holds_intensity_frames(name)) content.frames = esi::test::noise_frames(0, 5);
  for (const char* const run : {"1", "2"}) {
    std::filesystem::create_directory(folder / run);
    write_recording(folder / run / name, content);
    // Longer than the unit of the times that HDF5 would keep.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  }
  CHECK((contents_of(folder / "1") == contents_of(folder / "2")));
}

TEST_CASE("How events are cut into packets does not show in the file") {
  const TempFolder folder;
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  const Content content{random_events(30000, 5, 8), {}};
  for (const std::size_t longest : {1u, 70000u}) {
    const auto run = folder / std::to_string(longest);
    std::filesystem::create_directory(run);
    const auto writer = esi::open_recording_writer(run / name, esi::test::kWriteOptions);
    for (const Packet& packet : esi::test::packets_of(content, longest)) writer->write(packet);
    writer->finish();
  }
  CHECK((contents_of(folder / "1") == contents_of(folder / "70000")));
}

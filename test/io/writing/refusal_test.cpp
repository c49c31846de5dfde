#include <fstream>

#include "io/writing/writer_fixtures.hpp"

using Catch::Contains;
using esi::Event;
using esi::open_recording_writer;
using esi::test::Content;
using esi::test::error_of;
using esi::test::kSensor;
using esi::test::kWriteOptions;
using esi::test::names_in;
using esi::test::TempFolder;

namespace {

Content some_content(bool with_frames) {
  Content content{esi::test::random_events({0, 0, 346, 260}, 100000, 4, 1), {}};
  if (with_frames) content.frames = esi::test::noise_frames(0, 8);
  return content;
}

std::size_t open_files() {
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++files;
  return files;
}

/// Of the largest file in a folder.
std::size_t largest_size(const std::filesystem::path& folder) {
  std::size_t largest = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) largest = std::max<std::size_t>(largest, entry.file_size());
  }
  return largest;
}

esi::Packet frame_packet(esi::Interval exposure, const cv::Mat& image) {
  esi::Packet packet;
  packet.frames.push_back({exposure, image});
  return packet;
}

esi::Packet event_packet(std::vector<Event> events) {
  esi::Packet packet;
  packet.events = std::move(events);
  return packet;
}

}  // namespace

TEST_CASE("A recording that could not be written to its last byte leaves nothing and never gets its name") {
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  const Content content = some_content(esi::holds_intensity_frames(name));
  const TempFolder whole;
  esi::test::write_recording(whole / name, content);
  const std::size_t size = largest_size(whole.path());
  const std::size_t files = open_files();
  for (const std::size_t limit : {std::size_t{0}, std::size_t{100}, std::size_t{3000}, size / 4, size / 2,
                                  size - 3000, size - 100, size - 1, size}) {
    INFO(name << ", cut at " << limit << " of " << size);
    const TempFolder folder;
    const esi::test::FileSizeLimit full(limit);
    if (limit < size) {
      const auto error = error_of([&] { esi::test::write_recording(folder / name, content); });
      CHECK_THAT(error.what(), Contains(folder.path().string()) && Contains("File too large"));
      CHECK(error.kind() == esi::Error::Kind::failure);
      CHECK(names_in(folder.path()).empty());
    } else {
      CHECK_NOTHROW(esi::test::write_recording(folder / name, content));
    }
    CHECK(open_files() == files);
  }
}

TEST_CASE("After a failed write nothing is taken, and finish fails") {
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  const TempFolder folder;
  const auto writer = open_recording_writer(folder / name, kWriteOptions);
  writer->write(event_packet({{10, 1, 1, true}}));
  CHECK_THROWS_AS(writer->write(event_packet({{9, 1, 1, true}})), esi::Error);
  CHECK_THROWS_WITH(writer->write(event_packet({{11, 1, 1, true}})), Contains("write it anew"));
  CHECK_THROWS_WITH(writer->finish(), Contains("write it anew"));
  CHECK_FALSE(std::filesystem::exists(folder / name));
}

TEST_CASE("Without finish nothing stays, and what was there stays as it was") {
  const std::string name = GENERATE("a.h5", "a.aedat4", "a.txt");
  const TempFolder folder;
  folder.write(name, "old");
  {
    const auto writer = open_recording_writer(folder / name, kWriteOptions);
    for (const esi::Packet& packet : packets_of(some_content(esi::holds_intensity_frames(name)))) {
      writer->write(packet);
    }
    CHECK(names_in(folder.path()).size() > 1);
  }
  CHECK(names_in(folder.path()) == std::vector<std::string>{name});
  CHECK(esi::test::content_of(folder / name) == "old");
  esi::test::write_recording(folder / name, some_content(false));
  CHECK(esi::test::content_of(folder / name) != "old");
}

TEST_CASE("What no recording can hold is refused with where it is") {
  const cv::Mat1b grey(260, 346, std::uint8_t{1});
  struct Row {
    std::vector<esi::Packet> packets;
    std::string message;
  };
  const std::vector<Row> rows = {
      {{event_packet({{10, 1, 1, true}, {9, 1, 1, true}})}, "an event at 9 us"},
      {{event_packet({{10, 1, 1, true}}), event_packet({{9, 1, 1, true}})}, "after one at 10 us"},
      {{event_packet({{10, 346, 1, true}})}, "(346, 1), 10 us"},
      {{event_packet({{10, 1, 260, true}})}, "(1, 260)"},
      {{event_packet({{INT64_MAX, 1, 1, true}})}, "9223372036854775807"},
      {{frame_packet({5, 4}, grey)}, "from 5 to 4 us"},
      {{frame_packet({5, 10}, grey), frame_packet({4, 9}, grey)}, "ends at 10 us"},
      {{frame_packet({5, 10}, grey.t())}, "260x346"},
      {{frame_packet({5, 10}, cv::Mat3b(260, 346))}, "type 16"},
  };
  for (const Row& row : rows) {
    const TempFolder folder;
    const auto writer = open_recording_writer(folder / "a.aedat4", kWriteOptions);
    const auto error = error_of([&] {
      for (const esi::Packet& packet : row.packets) writer->write(packet);
    });
    CHECK_THAT(error.what(), Contains("a.aedat4: ") && Contains(row.message));
  }
}

TEST_CASE("What one format cannot hold is refused with another that can") {
  const TempFolder folder;
  const auto refused = [&](const std::string& name, const esi::Packet& packet) {
    return std::string(
        error_of([&] { open_recording_writer(folder / name, kWriteOptions)->write(packet); }).what());
  };
  const esi::Packet shallow = frame_packet({5, 10}, cv::Mat1b(260, 346));
  const esi::Packet deep = frame_packet({5, 10}, cv::Mat1w(260, 346));
  CHECK_THAT(refused("a.h5", shallow), Contains("write an .aedat4 file"));
  CHECK_THAT(refused("a.txt", deep), Contains("write an .aedat4 file"));
  CHECK_THAT(refused("a.h5", event_packet({{-1, 1, 1, true}})), Contains("time offset"));
  CHECK_THAT(refused("a.h5", event_packet({{1'650'000'000'000'000, 1, 1, true}})), Contains("time offset"));
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("A recording that cannot be begun is refused before anything is written") {
  struct Row {
    std::string name;
    esi::WriteOptions options;
    std::string message;
  };
  const std::vector<Row> rows = {
      {"a.dat", kWriteOptions, ".h5, .hdf5, .aedat4 or .txt"},
      {"a", kWriteOptions, "''"},
      {"a.h5", {{0, 260}}, "0x260"},
      {"a.txt", {{346, 65537}}, "346x65537"},
      {"a.txt", {kSensor, INT64_MIN}, "-9223372036854775808"},
      {"a.aedat4", {{32768, 1}}, "32767"},
      {"with/a.txt", kWriteOptions, "with/images.txt: is there already"},
      {"with2/a.txt", kWriteOptions, "with2/images: is there already"},
  };
  const TempFolder folder;
  std::filesystem::create_directories(folder / "with");
  std::filesystem::create_directories(folder / "with2" / "images");
  folder.write("with/images.txt", "");
  const auto before = names_in(folder.path());
  for (const Row& row : rows) {
    const auto error = error_of([&] { open_recording_writer(folder / row.name, row.options); });
    CHECK_THAT(error.what(), Contains(row.name) || Contains("images"));
    CHECK_THAT(error.what(), Contains(row.message));
    CHECK(error.kind() == esi::Error::Kind::usage);
    CHECK(names_in(folder.path()) == before);
  }
  for (const std::string name : {"a.h5", "a.aedat4", "a.txt"}) {
    const auto path = std::filesystem::path(esi::test::kReadOnlyFolder) / name;
    CHECK_THAT(error_of([&] { open_recording_writer(path, kWriteOptions); }).what(),
               Contains("/sys/" + name));
  }
}

// Intensity frames of MVSEC and Monash beside the events.
#include <catch2/catch.hpp>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "support/hdf5_layouts.hpp"
#include "support/random_events.hpp"
#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

constexpr hsize_t kHeight_px = 6, kWidth_px = 8, kImageBytes = 48;

/// Byte i of image n.
std::uint8_t pixel(std::size_t n, std::size_t i) { return static_cast<std::uint8_t>(n * 31 + i * 3); }

std::vector<std::uint8_t> images_of(std::size_t count) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t i = 0; i < kImageBytes; ++i) bytes.push_back(pixel(n, i));
  }
  return bytes;
}

bool shows(const IntensityFrame& frame, std::size_t n) {
  if (frame.image.type() != CV_8UC1 || frame.image.size() != cv::Size(kWidth_px, kHeight_px)) return false;
  for (std::size_t i = 0; i < kImageBytes; ++i) {
    if (frame.image.data[i] != pixel(n, i)) return false;
  }
  return true;
}

/// 30000 events, about 5 us apart; a frame each 2000 us from `t_first_us` on.
std::vector<double> frame_times_s(std::size_t count, std::int64_t t_first_us) {
  std::vector<double> times;
  for (std::size_t n = 0; n < count; ++n) {
    times.push_back(static_cast<double>(t_first_us + static_cast<std::int64_t>(n) * 2000) / 1e6);
  }
  return times;
}

const std::vector<Event>& events() {
  static const std::vector<Event> events = random_events({0, 0, kWidth_px, kHeight_px}, 30000, 5, 1);
  return events;
}

Reading read_mvsec(
    const TempFolder& folder, const std::vector<hsize_t>& extent, const std::vector<std::uint8_t>& images,
    const std::vector<double>& times_s, const std::vector<hsize_t>& chunk = {},
    const std::function<void(Hdf5Writer&)>& change = [](Hdf5Writer&) {}) {
  {
    Hdf5Writer file(folder / "a.h5");
    write_mvsec(file, "/davis/left/events", mvsec_rows(events()), 1000);
    write_images(file, "/davis/left/", extent, images, times_s, chunk);
    change(file);
  }
  return read_hdf5(folder / "a.h5");
}

TEST_CASE("MVSEC images come with the events that pass their time, however they are stored") {
  const TempFolder folder;
  constexpr std::size_t kCount = 90;  // From before the first event until after the last, at 150 ms.
  const std::vector<double> times = frame_times_s(kCount, -5000);
  for (const std::vector<hsize_t>& chunk :
       {std::vector<hsize_t>{}, {1, 6, 8}, {7, 6, 8}, {90, 6, 8}, {4, 4, 8}, {4, 6, 3}, {7, 4, 5}}) {
    INFO("chunk " << (chunk.empty() ? "none" : std::to_string(chunk[0] * 100 + chunk[1] * 10 + chunk[2])));
    const Reading reading =
        read_mvsec(folder, {kCount, kHeight_px, kWidth_px}, images_of(kCount), times, chunk);
    CHECK(reading.events == events());
    CHECK(reading.header.has_intensity_frames);
    CHECK(reading.header.sensor == SensorSize{kWidth_px, kHeight_px});
    CHECK(reading.largest_frame_count == 4);
    CHECK_FALSE(reading.losses.any());
    REQUIRE(reading.frames.size() == kCount);
    std::size_t too_early = 0, late = 0, wrong = 0;
    for (std::size_t n = 0; n < kCount; ++n) {
      const std::int64_t t_us = -5000 + static_cast<std::int64_t>(n) * 2000;
      const Interval& exposure = reading.frames[n].exposure;
      wrong += exposure.begin_us == t_us && exposure.end_us == t_us && shows(reading.frames[n], n) ? 0 : 1;
      // Not before an event has passed it, unless there is none; not after the packet that does.
      const bool is_passed = t_us <= events().back().t_us;
      too_early += is_passed && reading.newest_event_us[n] < t_us ? 1 : 0;
      const auto passing = std::partition_point(events().begin(), events().end(),
                                                [t_us](const Event& event) { return event.t_us < t_us; });
      const auto index = static_cast<std::size_t>(passing - events().begin());
      const std::size_t packet_end =
          std::min(index - index % kPacketEvents + kPacketEvents, events().size()) - 1;
      late += is_passed && reading.newest_event_us[n] > events()[packet_end].t_us ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(too_early == 0);
    CHECK(late == 0);
  }
}

TEST_CASE("Damaged MVSEC images are counted and noted, and cost no events") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto replace = [](const char* path, const std::vector<hsize_t>& extent, hid_t type) {
    return [=](Hdf5Writer& file) {
      file.remove(path);
      file.dataset(path, extent, {.type = type});
    };
  };
  struct Case {
    std::string what;
    std::vector<double> times_s;
    std::function<void(Hdf5Writer&)> change;
    std::size_t frames;
    std::int64_t damage;
    std::string note;
  };
  const std::vector<double> times = frame_times_s(6, 0);
  const std::string images = "/davis/left/image_raw";
  const std::string stamps = "/davis/left/image_raw_ts";
  const auto nothing = [](Hdf5Writer&) {};
  const auto corrupt = [&](Hdf5Writer& file) {
    const hid_t id = H5Dopen2(file.id(), images.c_str(), H5P_DEFAULT);
    const hsize_t offset[] = {2, 0, 0};
    H5Dwrite_chunk(id, H5P_DEFAULT, 0, offset, 16, "this is not gzip");
    H5Dclose(id);
  };
  const std::vector<Case> cases = {
      {"a chunk of two", times, corrupt, 4, 2, "frame 2"},
      {"times that are none",
       {0, nan, 0.002, 1e300, 0.004, 0.005},
       nothing,
       4,
       2,
       "frame 1 has no valid time"},
      {"too few times", {0, 0.001}, nothing, 0, 1, "6 images"},
      {"no times", times, [&](Hdf5Writer& file) { file.remove(stamps); }, 0, 1, "image_raw_ts"},
      {"whole times", times, replace(stamps.c_str(), {6}, H5T_STD_I64LE), 0, 1, "floating-point"},
      {"16 bits", times, replace(images.c_str(), {6, 6, 8}, H5T_STD_U16LE), 0, 1, "images of 8 bits"},
      {"flat", times, replace(images.c_str(), {6, 48}, H5T_STD_U8LE), 0, 1, "image"},
      {"four dimensions", times, replace(images.c_str(), {6, 6, 8, 1}, H5T_STD_U8LE), 0, 1, "4 dimensions"},
      {"no pixels", times, replace(images.c_str(), {6, 0, 8}, H5T_STD_U8LE), 0, 1, "values per row"},
      {"absurd", times, replace(images.c_str(), {6, hsize_t{1} << 40, hsize_t{1} << 40}, H5T_STD_U8LE), 0, 1,
       ""},
      {"never written", times, replace(images.c_str(), {6, 6, 8}, H5T_STD_U8LE), 0, 6, "row 0 is not stored"},
      {"far side", times, replace(images.c_str(), {6, 1, 70000}, H5T_STD_U8LE), 0, 1, "70000x1"},
  };
  const TempFolder folder;
  for (const Case& test : cases) {
    INFO(test.what);
    const Reading reading = read_mvsec(folder, {6, 6, 8}, images_of(6), test.times_s, {2, 6, 8}, test.change);
    CHECK(reading.events == events());
    CHECK(reading.frames.size() == test.frames);
    CHECK(reading.losses.of(Damage::corrupt_packet) == test.damage);
    CHECK(reading.header.has_intensity_frames);
    REQUIRE(reading.header.notes.size() == 1);
    CHECK_THAT(reading.header.notes[0], Contains("intensity frames are left out") && Contains(test.note));
  }
}

TEST_CASE("Images of another size than --size are left out") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    write_mvsec(file, "/davis/left/events", mvsec_rows(events()), 1000);
    write_images(file, "/davis/left/", {1, 6, 8}, images_of(1), {0});
  }
  ReadOptions options;
  options.size = "9x6";
  const Reading reading = read_hdf5(folder / "a.h5", options);
  CHECK(reading.frames.empty());
  CHECK_THAT(reading.header.notes.at(0), Contains("8x6, but the sensor 9x6"));
}

TEST_CASE("Monash images are read, grey or in colour; damaged ones are left out") {
  const TempFolder folder;
  std::vector<std::uint8_t> colours(kImageBytes * 3);
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = static_cast<std::uint8_t>(i * 7);
  cv::Mat grey;
  cv::cvtColor(cv::Mat(kHeight_px, kWidth_px, CV_8UC3, colours.data()), grey, cv::COLOR_BGR2GRAY);
  {
    Hdf5Writer file(folder / "a.h5");
    write_monash(file, events());
    write_attribute(file, "/", "sensor_resolution", {kHeight_px, kWidth_px});
    const auto add = [&](int n, const std::vector<hsize_t>& extent, const std::vector<std::uint8_t>& bytes,
                         hid_t type = H5T_STD_U8LE) {
      std::string path = "/images/image00000000" + std::to_string(n);
      file.dataset(path, extent, {.type = type}, H5T_NATIVE_UINT8, bytes.data());
      if (n != 2) write_attribute(file, path, "timestamp", {n * 0.001});
    };
    add(0, {6, 8}, images_of(1));
    add(1, {6, 8, 3}, colours);
    add(2, {6, 8}, images_of(1));  // Without a time.
    add(3, {6, 8, 1}, images_of(1));
    add(4, {6, 8, 2}, images_of(2));
    add(5, {8, 6}, images_of(1));
    add(6, {6, 8}, images_of(1), H5T_STD_U16LE);
    add(7, {48}, images_of(1));
    add(8, {6, 8}, images_of(1));
  }
  const Reading reading = read_hdf5(folder / "a.h5");
  CHECK(reading.events == events());
  REQUIRE(reading.frames.size() == 4);
  CHECK(shows(reading.frames[0], 0));
  CHECK(reading.frames[1].image.type() == CV_8UC1);
  CHECK(cv::countNonZero(reading.frames[1].image != grey) == 0);
  CHECK(shows(reading.frames[2], 0));
  CHECK(reading.frames[3].exposure == Interval{8000, 8000});
  CHECK(reading.losses.of(Damage::corrupt_packet) == 5);
  REQUIRE(reading.header.notes.size() == 1);
  CHECK_THAT(reading.header.notes[0], Contains("frame 2 has no valid time"));
}

}  // namespace

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "io/aedat2/read_aedat2.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

// A DAVIS with so few pixels that a frame can be written out: --chip and --size say so.
constexpr int kWidth_px = 4, kHeight_px = 3;

const std::string kHeader = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");

/// Of the pixel in that column and row of the picture: all differ, and none is 0.
int signal_of(int column, int row) { return 100 + 10 * row + column; }
constexpr int kReset = 900;

/// A reading of the pixel in that column and row of the picture, 1 us after the one before.
class Recorder {
 public:
  explicit Recorder(std::uint32_t t_us) : t_us_(t_us) {}

  std::uint32_t t_us() const { return t_us_; }
  void wait(std::uint32_t duration_us) { t_us_ += duration_us; }
  void reset(int column, int row) { add(davis_reset_read(column, kHeight_px - 1 - row, kReset)); }
  void signal(int column, int row) {
    add(davis_signal_read(column, kHeight_px - 1 - row, kReset - signal_of(column, row)));
  }
  void add(std::uint32_t address) { records_ += aedat2_record(address, t_us_++); }
  const std::string& records() const { return records_; }

 private:
  std::uint32_t t_us_;
  std::string records_;
};

using Reading = void (Recorder::*)(int, int);

/// All pixels column by column, from the top left as a DAVIS240C does.
void read_out(Recorder& recorder, Reading read) {
  for (int column = 0; column < kWidth_px; ++column) {
    for (int row = 0; row < kHeight_px; ++row) (recorder.*read)(column, row);
  }
}

void take_frame(Recorder& recorder) {
  read_out(recorder, &Recorder::reset);
  recorder.wait(1000);
  read_out(recorder, &Recorder::signal);
  recorder.wait(500);
}

cv::Mat1w expected_image() {
  cv::Mat1w image(kHeight_px, kWidth_px);
  for (int row = 0; row < kHeight_px; ++row) {
    for (int column = 0; column < kWidth_px; ++column) {
      const int value = signal_of(column, row);
      image(row, column) = static_cast<std::uint16_t>(64 * value + value / 16);
    }
  }
  return image;
}

bool is_expected(const IntensityFrame& frame) {
  const cv::Mat1w expected = expected_image();
  return frame.image.type() == CV_16UC1 && frame.image.size() == expected.size() &&
         cv::norm(frame.image, expected, cv::NORM_INF) == 0;
}

FormatReading read_records(const std::string& records) {
  return read_aedat2_bytes(kHeader + records, with_chip("DAVIS240", "4x3"));
}

}  // namespace

TEST_CASE("The readings of an AEDAT 2 file's intensity frame become its picture") {
  Recorder recorder(100);
  take_frame(recorder);
  const FormatReading content = read_records(recorder.records());
  REQUIRE(content.all.frames.size() == 1);
  CHECK(is_expected(content.all.frames[0]));
  // From the last of 12 resets to the first signal.
  CHECK(content.all.frames[0].exposure == Interval{111, 1112});
  CHECK(content.all.events.empty());
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
}

TEST_CASE("A whole intensity frame of a DAVIS240C stands as the events do, columns from the left") {
  std::string records;
  for (const auto read : {davis_reset_read, davis_signal_read}) {
    for (int x = 0; x < 240; ++x) {
      for (int y = 179; y >= 0; --y) {
        // Bright are the corners: top left 1000, top right 500, bottom left 250, bottom right 0.
        int value = 30;
        if (x == 0 && y == 179) value = 1000;
        if (x == 239 && y == 179) value = 500;
        if (x == 0 && y == 0) value = 250;
        if (x == 239 && y == 0) value = 0;
        records += aedat2_record(read(x, y, read == davis_reset_read ? 1023 : 1023 - value), 10);
      }
    }
    records += aedat2_record(davis_address(239 - 17, 179 - 5, true), 20);  // an event in between
  }
  const FormatReading content = read_aedat2_bytes(kHeader + records);
  REQUIRE(content.all.frames.size() == 1);
  const cv::Mat1w image = content.all.frames[0].image;
  REQUIRE(image.size() == cv::Size(240, 180));
  CHECK(image(0, 0) == 64062);
  CHECK(image(0, 239) == 32031);
  CHECK(image(179, 0) == 16015);
  CHECK(image(179, 239) == 0);
  CHECK(image(90, 120) == 1921);
  CHECK(content.all.events == std::vector<Event>{{20, 17, 5, true}, {20, 17, 5, true}});
}

TEST_CASE("A pixel of an AEDAT 2 frame is the reset less the signal, from 0 to the full 16 bits") {
  const auto [reset, signal, value] = GENERATE(table<int, int, int>(
      {{1023, 0, 65535}, {512, 511, 64}, {700, 700, 0}, {300, 400, 0}, {1023, 511, 32800}}));
  const std::string records =
      aedat2_record(davis_reset_read(0, 0, reset), 1) + aedat2_record(davis_signal_read(0, 0, signal), 2);
  const FormatReading content = read_aedat2_bytes(kHeader + records, with_chip("DAVIS240", "1x1"));
  REQUIRE(content.all.frames.size() == 1);
  CHECK(cv::Mat1w(content.all.frames[0].image)(0, 0) == value);
}

TEST_CASE("Intensity frames of AEDAT 2 may begin at any corner, by columns or by rows") {
  struct Order {
    bool from_right, from_bottom, by_rows;
  };
  const auto order = GENERATE(Order{false, true, false}, Order{true, false, false}, Order{true, true, true},
                              Order{false, false, true});
  Recorder recorder(0);
  const auto read_out_so = [&](Reading read) {
    for (int i = 0; i < kWidth_px * kHeight_px; ++i) {
      const int column = order.by_rows ? i % kWidth_px : i / kHeight_px;
      const int row = order.by_rows ? i / kWidth_px : i % kHeight_px;
      (recorder.*read)(order.from_right ? kWidth_px - 1 - column : column,
                       order.from_bottom ? kHeight_px - 1 - row : row);
    }
  };
  for (int i = 0; i < 3; ++i) {
    read_out_so(&Recorder::reset);
    read_out_so(&Recorder::signal);
  }
  const FormatReading content = read_records(recorder.records());
  REQUIRE(content.all.frames.size() == 3);
  CHECK(std::all_of(content.all.frames.begin(), content.all.frames.end(), is_expected));
  CHECK(content.notes().empty());
}

TEST_CASE("An intensity frame of a rolling shutter is exposed from its first reset") {
  Recorder recorder(50);
  const auto column_of = [&](Reading read, int column) {
    for (int row = 0; row < kHeight_px; ++row) (recorder.*read)(column, row);
  };
  for (int frame = 0; frame < 2; ++frame) {
    for (int column = 0; column < kWidth_px + 2; ++column) {
      if (column < kWidth_px) column_of(&Recorder::reset, column);
      if (column >= 2) column_of(&Recorder::signal, column - 2);
    }
  }
  const FormatReading content = read_records(recorder.records());
  REQUIRE(content.all.frames.size() == 2);
  CHECK(is_expected(content.all.frames[0]));
  CHECK(is_expected(content.all.frames[1]));
  CHECK(content.all.frames[0].exposure == Interval{50, 59});
  CHECK(content.all.frames[1].exposure == Interval{74, 83});
}

TEST_CASE("An AEDAT 2 recording that begins or ends anywhere within a frame has the whole ones") {
  const bool is_rolling = GENERATE(false, true);
  Recorder recorder(0);
  for (int frame = 0; frame < 3; ++frame) {
    if (!is_rolling) {
      take_frame(recorder);
      continue;
    }
    for (int column = 0; column < kWidth_px; ++column) {
      for (const Reading read : {&Recorder::reset, &Recorder::signal}) {
        for (int row = 0; row < kHeight_px; ++row) (recorder.*read)(column, row);
      }
    }
  }
  constexpr int readings = 2 * kWidth_px * kHeight_px;
  for (int first = 0; first <= readings; ++first) {
    for (const int cut : {0, 1, 11, 12, 13, 23}) {
      INFO(first << " readings are missing at the front, " << cut << " at the end");
      const std::string records = recorder.records().substr(
          static_cast<std::size_t>(first) * 8, static_cast<std::size_t>(3 * readings - first - cut) * 8);
      const FormatReading content = read_records(records);
      const bool is_whole_at_front = first == 0 || first == readings;
      REQUIRE(content.all.frames.size() == 3U - (first > 0 ? 1 : 0) - (cut > 0 ? 1 : 0));
      REQUIRE(std::all_of(content.all.frames.begin(), content.all.frames.end(), is_expected));
      CHECK(content.header.notes.size() == (is_whole_at_front && cut == 0 ? 0 : 1));
      CHECK(content.losses.text().empty());
    }
  }
}

TEST_CASE("An intensity frame of AEDAT 2 that misses a reading is left out, those around it are read") {
  Recorder recorder(0);
  for (int frame = 0; frame < 3; ++frame) take_frame(recorder);
  for (std::size_t missing = 24; missing < 48; ++missing) {
    INFO("reading " << missing);
    std::string records = recorder.records();
    records.erase(missing * 8, 8);
    const FormatReading content = read_records(records);
    REQUIRE(content.all.frames.size() == 2);
    CHECK(content.all.frames[0].exposure == Interval{11, 1012});
    CHECK(content.all.frames[1].exposure.duration_us() == 1001);
    CHECK(is_expected(content.all.frames[1]));
    CHECK_THAT(content.notes(), Contains("readings are missing"));
    CHECK(content.header.notes.size() == 1);
  }
}

TEST_CASE("Events, IMU words and readings beyond the sensor don't disturb an intensity frame of AEDAT 2") {
  Recorder recorder(0);
  read_out(recorder, &Recorder::reset);
  recorder.add(davis_address(1, 1, true));
  recorder.add(0x80000C00U | 3U << 28);
  recorder.add(0x80000800U);  // the deprecated second read
  recorder.add(davis_reset_read(4, 0, 5));
  recorder.add(davis_signal_read(0, 3, 5));
  read_out(recorder, &Recorder::signal);
  const FormatReading content = read_records(recorder.records());
  REQUIRE(content.all.frames.size() == 1);
  CHECK(is_expected(content.all.frames[0]));
  CHECK(content.all.events == std::vector<Event>{{12, 2, 1, true}});
  CHECK(content.notes().empty());
}

}  // namespace esi::test

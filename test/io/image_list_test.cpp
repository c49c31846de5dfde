// The pictures that images.txt lists beside a text recording.
#include "esi/io/image_list.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_source.hpp"
#include "support/scripted_reader.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

/// A folder with events.txt: one event a millisecond, from 1 s to 2 s.
class Sequence {
 public:
  Sequence() {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "1." + std::to_string(1000 + i).substr(1) + " 3 2 1\n";
    folder_.write("events.txt", text);
    std::filesystem::create_directory(folder_ / "images");
  }

  /// A picture of one grey.
  void picture(const std::string& name, int grey) const {
    cv::imwrite((folder_ / ("images/" + name)).string(), cv::Mat1b(4, 6, static_cast<unsigned char>(grey)));
  }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  std::unique_ptr<EventSource> open() const { return open_recording(folder_ / "events.txt", {}); }

 private:
  TempFolder folder_;
};

std::string notes_of(const EventSource& source) {
  std::string text;
  for (const std::string& note : source.header().notes) text += note + "\n";
  return text;
}

}  // namespace

TEST_CASE("listed pictures come among the events in order of time") {
  const Sequence sequence;
  for (const int grey : {10, 20, 30, 40, 50, 60}) sequence.picture(std::to_string(grey) + ".png", grey);
  sequence.write("images.txt",
                 "# time file\n0.1 images/10.png\n0.9 images/20.png\n1.5 images/40.png\r\n"
                 "1.0005 images/30.png\n1.999 images/50.png\n2.0 images/60.png\n");
  const auto source = sequence.open();
  CHECK(source->header().has_intensity_frames);
  Packet packet;
  std::vector<std::pair<std::int64_t, int>> seen;
  std::int64_t newest_us = 0;
  std::size_t events = 0;
  while (source->next(packet)) {
    if (!packet.events.empty()) newest_us = packet.events.back().t_us;
    events += packet.events.size();
    for (const IntensityFrame& frame : packet.frames) {
      CHECK(frame.exposure.begin_us == frame.exposure.end_us);
      CHECK(frame.image.size() == cv::Size(6, 4));
      CHECK(frame.exposure.end_us <= newest_us);
      seen.emplace_back(frame.exposure.end_us, frame.image.at<unsigned char>(1, 1));
    }
  }
  CHECK(events == 1000);
  // Of those before the first event the last one; none after the last event.
  CHECK(seen ==
        std::vector<std::pair<std::int64_t, int>>{{900000, 20}, {1000500, 30}, {1500000, 40}, {1999000, 50}});
  CHECK_THAT(notes_of(*source), Contains("1 of the 6 pictures in images.txt are later"));
  CHECK_FALSE(source->losses().any());
}

TEST_CASE("a missing or broken picture is counted, and the rest is used") {
  const Sequence sequence;
  sequence.picture("a.png", 1);
  sequence.write("images/b.png", "\x89PNG\r\n\x1a\nbroken");
  sequence.write("images.txt", "1.1 images/a.png\n1.2 images/b.png\n1.3 images/c.png\n1.4 images/a.png\n");
  const auto source = sequence.open();
  CHECK(drain(*source).frames.size() == 2);
  CHECK(source->losses().of(Damage::unreadable_frame) == 2);
}

TEST_CASE("an images.txt that is something else, or has no pictures, does not stop the events") {
  struct Row {
    std::string text, told;
  };
  const auto row =
      GENERATE(Row{"1.1 images/a.png\n1.2 images/b.png\n", "none of the 2 pictures"},
               Row{"images/a.png\n", "line 1 is not a time"}, Row{"1.1\n", "line 1"},
               Row{"# only\nnan images/a.png\n", "line 2"}, Row{"1e300 images/a.png\n", "line 1"});
  const Sequence sequence;
  sequence.write("images.txt", row.text);
  const auto source = sequence.open();
  CHECK_FALSE(source->header().has_intensity_frames);
  const Packet all = drain(*source);
  CHECK(all.events.size() == 1000);
  CHECK(all.frames.empty());
  CHECK_THAT(notes_of(*source), Contains(row.told));
  CHECK_FALSE(source->losses().any());
}

TEST_CASE("however sparse the events, few pictures are in memory at a time") {
  const Sequence sequence;
  sequence.picture("a.png", 1);
  std::string list;
  for (int i = 0; i < 900; ++i) list += "1." + std::to_string(1000 + i).substr(1) + "5 images/a.png\n";
  sequence.write("images.txt", list);
  const auto source = sequence.open();
  Packet packet;
  std::size_t frames = 0;
  while (source->next(packet)) {
    CHECK(packet.frames.size() <= 80);  // what the reader gives at once, and what the gate holds back
    frames += packet.frames.size();
  }
  CHECK(frames == 900);
}

TEST_CASE("slider_depth has its camera's pictures among its events") {
  const auto recording = shared_data("txt/slider_depth/events_chunk.txt");
  if (!recording) return;
  const auto source = open_recording(*recording, {});
  const Packet all = drain(*source);
  REQUIRE(all.frames.size() == 5);  // the events cover frames 0 to 4 of 87
  CHECK(all.frames[1].exposure.end_us == 38766);
  CHECK(all.frames[1].image.size() == cv::Size(240, 180));
}

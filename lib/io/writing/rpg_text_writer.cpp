#include "esi/io/writing/rpg_text_writer.hpp"

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/io/writing/picture_folder.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

/// Longer than any line of an event: 21 characters of time, two coordinates, polarity.
constexpr std::size_t kMaxLineBytes = 48;

char* append_number(char* target, std::uint64_t number) {
  return std::to_chars(target, target + kMaxLineBytes / 2, number).ptr;
}

/// Seconds with 6 decimals.
char* append_seconds(char* target, std::int64_t t_us) {
  if (t_us < 0) *target++ = '-';
  const auto magnitude_us = static_cast<std::uint64_t>(t_us < 0 ? -t_us : t_us);
  target = append_number(target, magnitude_us / 1000000);
  *target++ = '.';
  std::uint64_t fraction = magnitude_us % 1000000;
  for (int i = 5; i >= 0; --i, fraction /= 10) target[i] = static_cast<char>('0' + fraction % 10);
  return target + 6;
}

char* append_line(char* target, const Event& event, std::int64_t t_offset_us) {
  target = append_seconds(target, event.t_us + t_offset_us);
  *target++ = ' ';
  target = append_number(target, event.x);
  *target++ = ' ';
  target = append_number(target, event.y);
  *target++ = ' ';
  *target++ = event.on ? '1' : '0';
  *target++ = '\n';
  return target;
}

class RpgTextWriter final : public RecordingWriter {
 public:
  RpgTextWriter(const fs::path& path, const WriteOptions& options)
      : name_(path.string()),
        t_offset_us_(options.t_offset_us),
        pictures_(path.parent_path()),
        events_(path) {}

  void write(const Packet& packet) override {
    write_events(packet.events);
    for (const IntensityFrame& frame : packet.frames) write_frame(frame);
  }

  void finish() override {
    try {
      pictures_.commit();
      events_.commit();
    } catch (const Error&) {
      pictures_.withdraw();
      throw;
    }
  }

 private:
  void write_events(const std::vector<Event>& events) {
    text_.resize(events.size() * kMaxLineBytes);
    char* end = text_.data();
    for (const Event& event : events) end = append_line(end, event, t_offset_us_);
    events_.write(std::string_view(text_.data(), static_cast<std::size_t>(end - text_.data())));
  }

  /// Its time is the exposure's middle, as the camera driver of RPG's own recordings has it.
  void write_frame(const IntensityFrame& frame) {
    if (frame.image.depth() != CV_8U) {
      throw usage_error(name_ + ": pictures beside text have 8 bits, not 16; write an .aedat4 file");
    }
    const Interval& exposure = frame.exposure;
    pictures_.add(frame.image, exposure.begin_us + exposure.duration_us() / 2 + t_offset_us_);
  }

  std::string name_;
  std::int64_t t_offset_us_;
  PictureFolder pictures_;
  OutputFile events_;
  std::string text_;
};

}  // namespace

std::unique_ptr<RecordingWriter> open_rpg_text_writer(const fs::path& path, const WriteOptions& options) {
  return std::make_unique<RpgTextWriter>(path, options);
}

}  // namespace esi

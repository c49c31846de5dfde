#include "esi/io/text/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/core/error.hpp"
#include "esi/io/image_list.hpp"
#include "esi/io/text/buffer.hpp"
#include "esi/io/text/clock.hpp"
#include "esi/io/text/dialect.hpp"
#include "esi/io/text/fast_lines.hpp"
#include "esi/io/text/kind.hpp"
#include "esi/io/text/line.hpp"
#include "esi/io/text/preamble.hpp"

namespace esi {
namespace {

constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr std::int64_t kMillisecond_us = 1000;

std::unique_ptr<ByteSource> require_text(std::unique_ptr<ByteSource> bytes) {
  const std::string problem = describe_non_text(bytes->peek(kFormatHeadBytes));
  if (!problem.empty()) throw Error(fmt::format("{}: {}", bytes->name(), problem));
  return bytes;
}

/// Empty for what is no regular file.
class TextReader final : public FormatReader {
 public:
  TextReader(std::unique_ptr<ByteSource> bytes, const ReadOptions& options)
      : buffer_(require_text(std::move(bytes))),
        file_bytes_(buffer_.bytes().file_bytes()),
        max_unreadable_(options.max_unreadable),
        dialect_(open(options)) {
    layout_ = fast_layout(dialect_);
    clock_ = TextClock(dialect_.time_shift == 0);
  }

  const RecordingHeader& header() const override { return header_; }

  std::optional<double> fraction_read() const override {
    if (!file_bytes_) return std::nullopt;
    return std::min(1.0, static_cast<double>(buffer_.bytes().position()) / static_cast<double>(*file_bytes_));
  }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t before = packet.events.size();
    while (packet.events.size() == before && !is_at_end()) {
      if (buffer_.lines().empty()) buffer_.fill();
      const std::size_t room = before + kPacketEvents;
      while (!buffer_.lines().empty() && packet.events.size() < room) {
        take_plain_lines(packet.events, room);
        take_line(packet.events, losses);
      }
      if (buffer_.has_ended() && buffer_.lines().empty()) take_cut_line(packet.events, losses);
    }
    check_duration();
    if (packet.events.size() > before) return true;
    take_damage(losses);
    judge();
    return false;
  }

 private:
  TextDialect open(const ReadOptions& options);
  void take_plain_lines(std::vector<Event>& events, std::size_t room);
  void take_line(std::vector<Event>& events, Losses& losses);
  void take_cut_line(std::vector<Event>& events, Losses& losses);
  void take(const TextLine& line, std::string_view text, std::vector<Event>& events, Losses& losses);
  void take_damage(Losses& losses);
  void check_duration() const;
  void judge() const;
  bool is_at_end() const {
    return buffer_.has_ended() && buffer_.lines().empty() && buffer_.remainder().empty();
  }
  std::string unit_name() const { return dialect_.time_shift == 6 ? "seconds" : "microseconds"; }

  TextBuffer buffer_;
  std::optional<std::uintmax_t> file_bytes_;  ///< empty for a pipe
  double max_unreadable_;
  RecordingHeader header_;
  std::int64_t line_number_ = 0;  ///< of the last line taken
  TextDialect dialect_;
  std::optional<FastLayout> layout_;
  TextClock clock_{false};
  std::array<Event, 512> plain_;  ///< small enough to stay in the L1 cache
  bool has_noted_wrap_ = false;
  bool has_told_damage_ = false;

  std::int64_t data_lines_ = 0;
  std::int64_t unreadable_ = 0;
  std::string first_unreadable_;  ///< line 7 'nan 1 2 1': its time is not a number
};

TextDialect TextReader::open(const ReadOptions& options) {
  header_.format = "text";
  const TextPreamble preamble = read_preamble(buffer_);
  line_number_ = preamble.lines;
  if (buffer_.lines().empty() && buffer_.remainder().empty()) {
    throw Error(fmt::format("{}: it holds no events; write one a line, such as \"0.001 10 20 1\" (t x y p)",
                            buffer_.name()));
  }
  const std::string_view lines = buffer_.lines().empty() ? buffer_.remainder() : buffer_.lines();
  return decide_dialect(options, preamble, lines, buffer_.name(), header_);
}

void TextReader::take_plain_lines(std::vector<Event>& events, std::size_t room) {
  if (!layout_ || !clock_.has_started()) return;
  FastLines taken{};
  do {
    const auto target = std::span(plain_).first(std::min(plain_.size(), room - events.size()));
    taken = read_fast(*layout_, buffer_.lines(), clock_, target);
    events.insert(events.end(), target.begin(), target.begin() + static_cast<std::ptrdiff_t>(taken.events));
    buffer_.consume(taken.bytes);
    line_number_ += static_cast<std::int64_t>(taken.events);
    data_lines_ += static_cast<std::int64_t>(taken.events);
  } while (taken.events == plain_.size());
}

void TextReader::take_line(std::vector<Event>& events, Losses& losses) {
  const std::string_view lines = buffer_.lines();
  if (lines.empty()) return;
  const std::string_view line = lines.substr(0, lines.find('\n') + 1);
  ++line_number_;
  const PolarityCode code = dialect_.polarity;
  take(parse_line(line, dialect_), line, events, losses);
  if (dialect_.polarity != code) layout_ = fast_layout(dialect_);
  buffer_.consume(line.size());
}

// Without '\n' behind it, the last line may be one that a recorder did not finish.
void TextReader::take_cut_line(std::vector<Event>& events, Losses& losses) {
  const std::string_view text = buffer_.remainder();
  if (text.empty()) return;
  ++line_number_;
  const TextLine line = parse_line(text, dialect_);
  // A time that lost its last digits reads as one long ago.
  const bool has_cut_time = line.kind == TextLine::Kind::event && dialect_.columns.back() == TextColumn::t &&
                            clock_.has_started() && line.event.t_us < clock_.previous_us();
  if (line.kind == TextLine::Kind::unreadable || has_cut_time) {
    losses.add(Drop::cut_line);
  } else {
    take(line, text, events, losses);
  }
  buffer_.consume(text.size());
}

void TextReader::take(const TextLine& line, std::string_view text, std::vector<Event>& events,
                      Losses& losses) {
  if (line.kind == TextLine::Kind::comment) return;
  ++data_lines_;
  if (line.kind == TextLine::Kind::event) {
    events.push_back(line.event);
    events.back().t_us = clock_.accept(line.event.t_us);
    if (clock_.wrapped_bits() != 0 && !has_noted_wrap_) {
      has_noted_wrap_ = true;
      header_.notes.push_back(
          fmt::format("the {}-bit clock wraps (first at line {}): its times are unwrapped",
                      clock_.wrapped_bits(), line_number_));
    }
  } else if (line.kind == TextLine::Kind::outside_16_bits) {
    losses.add(Drop::outside_sensor);
  } else {
    losses.add(Drop::unreadable_line);
    if (++unreadable_ == 1) {
      first_unreadable_ = fmt::format("line {} {}: {}", line_number_, shown(text), line.problem);
    }
  }
}

// The end of a text that lies in a damaged archive.
void TextReader::take_damage(Losses& losses) {
  const std::string damage = buffer_.bytes().damage();
  if (damage.empty() || has_told_damage_) return;
  has_told_damage_ = true;
  losses.add(Damage::cut_packet);
  header_.notes.push_back(fmt::format("the archive is damaged behind line {} ({})", line_number_, damage));
}

void TextReader::check_duration() const {
  if (dialect_.is_unit_given || clock_.duration_us() <= kDay_us) return;
  throw Error(fmt::format(
      "{}: up to line {} it lasts {:.1f} days, if times are in {}; give their unit with --time-unit, perhaps "
      "{}",
      buffer_.name(), line_number_, static_cast<double>(clock_.duration_us()) / static_cast<double>(kDay_us),
      unit_name(), dialect_.time_shift == 6 ? "us" : "ns"));
}

// At the end of the recording.
void TextReader::judge() const {
  if (static_cast<double>(unreadable_) > max_unreadable_ * static_cast<double>(data_lines_)) {
    throw Error(
        fmt::format("{}: {} of {} lines cannot be read, the first at {}; correct them, or raise "
                    "--max-unreadable (now {})",
                    buffer_.name(), unreadable_, data_lines_, first_unreadable_, max_unreadable_));
  }
  if (data_lines_ == 0) {
    throw Error(fmt::format("{}: it holds no whole event; check the file", buffer_.name()));
  }
  const std::int64_t duration_us = clock_.duration_us();
  if (!dialect_.is_unit_given && duration_us > 0 && duration_us < kMillisecond_us) {
    throw Error(
        fmt::format("{}: it lasts only {} us, if times are in {}; give their unit with --time-unit (s, ms, "
                    "us or ns)",
                    buffer_.name(), duration_us, unit_name()));
  }
}

}  // namespace

std::unique_ptr<FormatReader> open_text(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  const std::filesystem::path path = bytes->path();
  auto reader = std::make_unique<TextReader>(std::move(bytes), options);
  return path.empty() ? std::move(reader) : with_listed_images(std::move(reader), path);
}

}  // namespace esi

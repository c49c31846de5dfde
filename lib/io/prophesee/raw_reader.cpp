#include "esi/io/prophesee/raw_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/io/prophesee/header_lines.hpp"
#include "esi/io/prophesee/raw_header.hpp"
#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {
namespace {

RecordingHeader describe(const PropheseeRawHeader& file) {
  RecordingHeader header;
  header.format = "prophesee-raw";
  header.layout = "Prophesee RAW, " + file.encoding;
  header.sensor = file.sensor;
  header.notes = file.notes;
  return header;
}

class PropheseeRawReader final : public FormatReader {
 public:
  PropheseeRawReader(ByteWindow bytes, const PropheseeRawHeader& file)
      : header_(describe(file)), bytes_(std::move(bytes)), decoder_(file.decoder) {}

  const RecordingHeader& header() const override { return header_; }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t before = packet.events.size();
    while (!at_end_ && packet.events.size() < before + kPacketEvents) {
      const auto words = bytes_.take(kDecodedAtOnceBytes);
      decoder_.decode(words, packet.events);
      at_end_ = words.size() < kDecodedAtOnceBytes;
      has_events_ = has_events_ || packet.events.size() > before;
      if (at_end_) finish(words.size() % decoder_.word_bytes(), losses);
    }
    return packet.events.size() > before;
  }

  std::optional<double> fraction_read() const override { return bytes_.fraction_taken(); }

 private:
  void finish(std::size_t bytes_left, Losses& losses) {
    if (decoder_.events_without_time() > 0) {
      if (!has_events_) {
        throw Error(
            fmt::format("{}: its {} events have no time, because no time word comes before them; the "
                        "file is damaged or no {} recording",
                        bytes_.name(), decoder_.events_without_time(), header_.layout));
      }
      header_.notes.push_back(
          fmt::format("{} events before the first time word have no time and are left out.",
                      decoder_.events_without_time()));
    }
    if (bytes_left == 0) return;
    losses.add(Damage::cut_packet);
    header_.notes.push_back(fmt::format("The file ends within a word, at byte {}.", bytes_.position()));
  }

  RecordingHeader header_;
  ByteWindow bytes_;
  EvtDecoder decoder_;
  bool has_events_ = false;
  bool at_end_ = false;
};

// Lines that only RAW files have. Comments in text files may begin alike, but not so.
bool is_raw_line(const PropheseeHeaderLines::Line& line) {
  static constexpr std::string_view kKeys[] = {"evt",
                                               "firmware_version",
                                               "integrator_name",
                                               "camera_integrator_name",
                                               "plugin_integrator_name",
                                               "plugin_name",
                                               "serial_number",
                                               "system_ID",
                                               "sensor_generation"};
  return std::find(std::begin(kKeys), std::end(kKeys), line.key) != std::end(kKeys) ||
         (line.key == "format" && line.value.starts_with("EVT"));
}

}  // namespace

bool looks_like_prophesee_raw(std::span<const std::byte> head) {
  const auto header = PropheseeHeaderLines::in(head);
  return std::any_of(header.lines.begin(), header.lines.end(), is_raw_line);
}

std::unique_ptr<FormatReader> open_prophesee_raw(std::unique_ptr<ByteSource> bytes,
                                                 const ReadOptions& /*options*/) {
  ByteWindow window(std::move(bytes));
  const PropheseeRawHeader header = read_raw_header(window);
  return std::make_unique<PropheseeRawReader>(std::move(window), header);
}

}  // namespace esi

#include "esi/io/prophesee/dat_reader.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/prophesee/dat_decoder.hpp"
#include "esi/io/prophesee/header_lines.hpp"
#include "esi/io/prophesee/word_blocks.hpp"

namespace esi {
namespace {

constexpr int kEvents2d = 0, kChangeDetection = 12, kTriggers = 14;  // event types
constexpr std::size_t kTypeBytes = 2;                                // the event type and the record's size

bool is_event_type(int type) { return type == kEvents2d || type == kChangeDetection; }

class PropheseeDatReader final : public FormatReader {
 public:
  PropheseeDatReader(ByteWindow bytes, RecordingHeader header)
      : header_(std::move(header)), bytes_(std::move(bytes)) {}

  const RecordingHeader& header() const override { return header_; }

  bool read(Packet& packet, Losses& losses) override {
    const std::size_t before = packet.events.size();
    while (!at_end_ && packet.events.size() < before + kPacketEvents) {
      const auto records = bytes_.take(kDecodedAtOnceBytes);
      decoder_.decode(records, packet.events);
      at_end_ = records.size() < kDecodedAtOnceBytes;
      if (records.size() % DatDecoder::kRecordBytes == 0) continue;
      losses.add(Damage::cut_packet);
      header_.notes.push_back(fmt::format("The file ends within an event, at byte {}.", bytes_.position()));
    }
    return packet.events.size() > before;
  }

  std::optional<double> fraction_read() const override { return bytes_.fraction_taken(); }

 private:
  RecordingHeader header_;
  ByteWindow bytes_;
  DatDecoder decoder_;
  bool at_end_ = false;
};

void take_type(ByteWindow& bytes) {
  const std::string& name = bytes.name();
  const auto head = bytes.take(kTypeBytes);
  if (head.size() < kTypeBytes) {
    throw Error(fmt::format("{}: the file ends within its header, at byte {}; copy it again", name,
                            bytes.position()));
  }
  const int type = std::to_integer<int>(head[0]);
  const int record_bytes = std::to_integer<int>(head[1]);
  const std::size_t position = bytes.position() - kTypeBytes;
  if (type == kTriggers) {
    throw Error(
        fmt::format("{}: it holds external triggers (event type 14 at byte {}), no events; give the file of "
                    "the change detection events",
                    name, position));
  }
  if (!is_event_type(type)) {
    throw Error(fmt::format("{}: event type {} at byte {} is not known; files of types 0 and 12 can be read",
                            name, type, position));
  }
  if (record_bytes != DatDecoder::kRecordBytes) {
    throw Error(
        fmt::format("{}: byte {} says that an event has {} bytes, but 8 are known; the file is "
                    "damaged or of another version",
                    name, position + 1, record_bytes));
  }
}

}  // namespace

// Lines alone don't tell it from a text file's comments, unless they are its own.
bool looks_like_prophesee_dat(std::span<const std::byte> head) {
  const auto header = PropheseeHeaderLines::in(head);
  if (header.lines.empty()) return false;
  const auto data = header.find("Data");
  if (data && data->starts_with("file containing")) return true;
  if (head.size() < header.bytes + kTypeBytes) return false;
  const int type = std::to_integer<int>(head[header.bytes]);
  return (is_event_type(type) || type == kTriggers) &&
         std::to_integer<std::size_t>(head[header.bytes + 1]) == DatDecoder::kRecordBytes;
}

std::unique_ptr<FormatReader> open_prophesee_dat(std::unique_ptr<ByteSource> bytes,
                                                 const ReadOptions& /*options*/) {
  ByteWindow window(std::move(bytes));
  const auto lines = peek_prophesee_header(window);
  RecordingHeader header;
  header.format = "prophesee-dat";
  header.layout = "Prophesee DAT";
  header.sensor = sensor_size_from(lines.find("Width").value_or(""), lines.find("Height").value_or(""));
  window.skip(lines.bytes);
  take_type(window);
  return std::make_unique<PropheseeDatReader>(std::move(window), std::move(header));
}

}  // namespace esi

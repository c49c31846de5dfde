#include "bad_input/bad_input.hpp"
#include "support/aedat4_file.hpp"

namespace esi::test {
namespace {

std::string int32(std::int32_t value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

std::vector<Aedat4Event> events_from(std::int64_t t_us, int count = 60) {
  std::vector<Aedat4Event> events;
  for (int i = 0; i < count; ++i) {
    events.push_back({t_us + 10 * i, static_cast<std::int16_t>(i), static_cast<std::int16_t>(i % 100),
                      static_cast<std::uint8_t>(i % 2)});
  }
  return events;
}

/// Packets of 60 events at 1 ms and 5 ms, and what `add` puts between them.
std::function<std::string()> between(const std::function<void(Aedat4File&)>& add,
                                     Aedat4Compression compression = Aedat4Compression::lz4) {
  return [=] {
    Aedat4File file(
        compression,
        aedat4_xml(aedat4_stream_xml(0, "EVTS", "346x260") + aedat4_stream_xml(1, "FRME", "346x260") +
                   aedat4_stream_xml(2, "IMUS", "") + aedat4_stream_xml(3, "TRIG", "")));
    file.add(0, aedat4_event_buffer(events_from(1000)));
    add(file);
    file.add(0, aedat4_event_buffer(events_from(5000)));
    return file.bytes();
  };
}

std::function<std::string()> with_packet(const std::string& buffer,
                                         Aedat4Compression compression = Aedat4Compression::lz4) {
  return between([=](Aedat4File& file) { file.add(0, buffer); }, compression);
}

std::function<std::string()> with_stored(const std::string& payload, Aedat4Compression compression) {
  return between([=](Aedat4File& file) { file.add_stored(0, payload); }, compression);
}

std::function<std::string()> with_size(std::int32_t size) {
  return between([=](Aedat4File& file) { file.add_stored(0, "payload", size); });
}

std::function<std::string()> with_frame(std::int8_t format, std::size_t bytes_per_pixel) {
  Aedat4Frame frame;
  frame.t_us = 3000;
  frame.format = format;
  frame.width_px = 346;
  frame.height_px = 260;
  frame.pixels = std::string(346 * 260 * bytes_per_pixel, '\x40');
  return between([=](Aedat4File& file) { file.add(1, aedat4_frame_buffer(frame)); });
}

Aedat4File good_file(Aedat4Compression compression = Aedat4Compression::lz4) {
  Aedat4File file = aedat4_event_file(compression);
  file.add(0, aedat4_event_buffer(events_from(1000)));
  file.add(0, aedat4_event_buffer(events_from(5000)));
  return file;
}

std::function<std::string()> with_xml(const std::string& xml) {
  return [=] {
    Aedat4File file(Aedat4Compression::lz4, xml);
    file.add(0, aedat4_event_buffer(events_from(1000)));
    return file.bytes();
  };
}

std::string entity_bomb() {
  std::string xml = "<?xml version=\"1.0\"?><!DOCTYPE dv [<!ENTITY a0 \"ha\">";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    xml += "<!ENTITY a" + std::to_string(i) + " \"" + before + before + "\">";
  }
  return xml + "]><dv version=\"2.0\"><node name=\"outInfo\">&a29;</node></dv>";
}

std::string flipped(std::string bytes, std::size_t position) {
  bytes[position] = static_cast<char>(bytes[position] ^ 0x55);
  return bytes;
}

std::string bomb(Aedat4Compression compression) {
  std::string zeros(std::size_t{64} << 20, '\0');
  return aedat4_compressed(zeros.replace(0, 4, int32(0x7fffffff)), compression);
}

const std::string kBuffer = aedat4_event_buffer(events_from(3000));
const std::string kLz4 = aedat4_compressed(kBuffer, Aedat4Compression::lz4);
const std::string kZstd = aedat4_compressed(kBuffer, Aedat4Compression::zstd);
const std::vector<std::string> kNone = {};

}  // namespace

BadInputs bad_aedat4() {
  return {
      "AEDAT 4",
      "recording.aedat4",
      {
          {"uncompressed", 0, "", with_packet(kBuffer, Aedat4Compression::none), kNone},
          {"LZ4_HIGH", 0, "", with_packet(kBuffer, Aedat4Compression::lz4_high), kNone},
          {"ZSTD", 0, "", with_packet(kBuffer, Aedat4Compression::zstd), kNone},
          {"ZSTD_HIGH", 0, "", with_packet(kBuffer, Aedat4Compression::zstd_high), kNone},
          {"recorder killed: table position -1, no table", 0, "",
           [] { return good_file().bytes_without_table(-1); }, kNone},
          {"recorder killed within a packet", 3, "1 cut_packet",
           [] {
             const std::string bytes = good_file().bytes_without_table(-1);
             return bytes.substr(0, bytes.size() - 20);
           },
           kNone},
          {"table position beyond the file", 0, "", [] { return good_file().bytes(1LL << 50); }, kNone},
          {"table that is garbage", 0, "",
           [] {
             const Aedat4File file = good_file();
             return file.bytes_without_table(static_cast<std::int64_t>(file.position())) + "rubbish!";
           },
           kNone},
          {"packet size negative", 3, "1 corrupt_packet", with_size(-1), kNone},
          {"packet size huge", 3, "1 corrupt_packet", with_size(INT32_MAX), kNone},
          {"packet of size zero", 0, "", between([](Aedat4File& file) { file.add_stored(0, ""); }), kNone},
          {"header cut", 1, "recording.aedat4", [] { return good_file().bytes().substr(0, 100); }, kNone},
          {"XML malformed", 1, "XML", with_xml("<dv version=\"2.0\"><node"), kNone},
          {"XML without sizes", 2, "--size", with_xml(aedat4_xml(aedat4_stream_xml(0, "EVTS", ""))), kNone},
          {"XML with an entity bomb", 1, "stream", [] { return with_xml(entity_bomb())(); }, kNone},
          {"no event stream", 1, "1: IMUS", with_xml(aedat4_xml(aedat4_stream_xml(1, "IMUS", ""))), kNone},
          {"two event streams", 2, "--stream",
           with_xml(
               aedat4_xml(aedat4_stream_xml(0, "EVTS", "346x260") + aedat4_stream_xml(4, "EVTS", "640x480"))),
           kNone},
          {"corrupt LZ4 frame", 3, "1 corrupt_packet", with_stored(flipped(kLz4, 8), Aedat4Compression::lz4),
           kNone},
          {"corrupt zstd frame", 3, "1 corrupt_packet",
           with_stored(flipped(kZstd, 4), Aedat4Compression::zstd), kNone},
          {"LZ4 bomb", 3, "1 corrupt_packet",
           [] { return with_stored(bomb(Aedat4Compression::lz4), Aedat4Compression::lz4)(); }, kNone},
          {"zstd bomb", 3, "1 corrupt_packet",
           [] { return with_stored(bomb(Aedat4Compression::zstd), Aedat4Compression::zstd)(); }, kNone},
          {"flatbuffer that does not verify", 3, "1 corrupt_packet",
           [] {
             std::string buffer = kBuffer;
             return with_packet(buffer.replace(4, 4, int32(0x7fffff)))();
           },
           kNone},
          {"negative coordinates", 3, "1 outside_sensor", between([](Aedat4File& file) {
             auto events = events_from(3000);
             events[7].x = -3;
             file.add(0, aedat4_event_buffer(events));
           }),
           kNone},
          {"16-bit frame among the events", 0, "", with_frame(2, 2), kNone},
          {"colour frame among the events", 0, "", with_frame(16, 3), kNone},
          {"frame of an unknown format", 3, "1 corrupt_packet", with_frame(77, 1), kNone},
          {"IMU and trigger packets among the events", 0, "", between([](Aedat4File& file) {
             file.add(2, "an IMU packet is not looked into");
             file.add(3, "nor is one of triggers");
           }),
           kNone},
          {"only the header, no packets", 1, "no events",
           [] { return aedat4_event_file(Aedat4Compression::lz4).bytes(); }, kNone},
      }};
}

}  // namespace esi::test

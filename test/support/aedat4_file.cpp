#include "support/aedat4_file.hpp"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace esi::test {
namespace {

// Little-endian, as the host is.
template <class Number>
std::string number(Number value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// What a table's slot holds: a number's bytes, or a vector or string with its length in front.
struct Slot {
  std::string scalar;
  std::string vector;
  std::size_t align = 4;  ///< of the vector's elements

  bool is_absent() const { return scalar.empty() && vector.empty(); }
};

template <class Number>
Slot scalar(Number value) {
  return {number(value), "", 4};
}

template <class Number>
Slot scalar(const std::optional<Number>& value) {
  return value ? scalar(*value) : Slot{};
}

Slot vector_of(std::size_t count, std::string_view elements, std::size_t align) {
  return {"", number(static_cast<std::uint32_t>(count)).append(elements), align};
}

void pad_to_multiple(std::string& bytes, std::size_t align) {
  while (bytes.size() % align != 0) bytes += '\0';
}

template <class Number>
void put(std::string& bytes, std::size_t position, Number value) {
  std::memcpy(bytes.data() + position, &value, sizeof value);
}

void append_vector(std::string& out, const Slot& slot) {
  while ((out.size() + 4) % 8 != slot.align % 8) out += '\0';
  out += slot.vector;
}

// 0 size, 4 offset of the table, 8 identifier, 12 vtable, then the table, then the vectors.
std::string flatbuffer(std::string_view identifier, const std::vector<Slot>& slots) {
  constexpr std::size_t vtable = 12;
  std::string out(8, '\0');
  out += identifier;
  out.resize(vtable + 4 + 2 * slots.size());
  pad_to_multiple(out, 8);
  const std::size_t table = out.size();
  put(out, 4, static_cast<std::uint32_t>(table - 4));
  out += number(static_cast<std::int32_t>(table - vtable));

  std::vector<std::size_t> places(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].is_absent()) continue;
    pad_to_multiple(out, slots[i].scalar.empty() ? 4 : slots[i].scalar.size());
    places[i] = out.size();
    out += slots[i].scalar.empty() ? std::string(4, '\0') : slots[i].scalar;
    put(out, vtable + 4 + 2 * i, static_cast<std::uint16_t>(places[i] - table));
  }
  put(out, vtable, static_cast<std::uint16_t>(4 + 2 * slots.size()));
  put(out, vtable + 2, static_cast<std::uint16_t>(out.size() - table));
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].vector.empty()) continue;
    append_vector(out, slots[i]);
    put(out, places[i], static_cast<std::uint32_t>(out.size() - slots[i].vector.size() - places[i]));
  }
  pad_to_multiple(out, 4);
  put(out, 0, static_cast<std::uint32_t>(out.size() - 4));
  return out;
}

std::string lz4_frame(std::string_view bytes, int level) {
  LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;  // 64 KB linked blocks, no sizes, no checksums
  preferences.compressionLevel = level;
  std::string out(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &preferences));
  return out;
}

std::string zstd_frame(std::string_view bytes, int level) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), level));
  return out;
}

}  // namespace

std::string aedat4_event_buffer(const std::vector<Aedat4Event>& events, std::size_t align) {
  std::string elements;
  for (const Aedat4Event& event : events) {
    elements += number(event.t_us) + number(event.x) + number(event.y) + number(event.polarity) +
                std::string(3, '\0');
  }
  return flatbuffer("EVTS", {vector_of(events.size(), elements, align)});
}

std::string aedat4_frame_buffer(const Aedat4Frame& frame) {
  return flatbuffer("FRME", {scalar(frame.t_us), Slot{}, Slot{}, scalar(frame.start_of_exposure_us),
                             scalar(frame.end_of_exposure_us), scalar(frame.format), scalar(frame.width_px),
                             scalar(frame.height_px), scalar(frame.x_px), scalar(frame.y_px),
                             vector_of(frame.pixels.size(), frame.pixels, 4), scalar(frame.exposure_us)});
}

std::string aedat4_stream_xml(int id, std::string_view type, std::string_view size, std::string_view source) {
  const std::size_t cross = size.find('x');
  const std::string sizes =
      size.empty()
          ? ""
          : fmt::format(R"(<attr key="sizeX" type="int">{}</attr><attr key="sizeY" type="int">{}</attr>)",
                        size.substr(0, cross), size.substr(cross + 1));
  return fmt::format(
      R"(<node name="{0}" path="/mainloop/Recorder/outInfo/{0}/">)"
      R"(<attr key="compression" type="string">LZ4</attr>)"
      R"(<attr key="typeIdentifier" type="string">{1}</attr>)"
      R"(<node name="info" path="/mainloop/Recorder/outInfo/{0}/info/">{2})"
      R"(<attr key="source" type="string">{3}</attr><attr key="tsOffset" type="long">1000000</attr></node></node>)",
      id, type, sizes, source);
}

std::string aedat4_xml(std::string_view streams) {
  return fmt::format(
      "<dv version=\"2.0\">\n<node name=\"outInfo\" path=\"/mainloop/Recorder/outInfo/\">{}</node>\n</dv>\n",
      streams);
}

std::string aedat4_compressed(std::string_view bytes, Aedat4Compression compression) {
  switch (compression) {
    case Aedat4Compression::none:
      return std::string(bytes);
    case Aedat4Compression::lz4:
      return lz4_frame(bytes, 0);
    case Aedat4Compression::lz4_high:
      return lz4_frame(bytes, 9);
    case Aedat4Compression::zstd:
      return zstd_frame(bytes, 1);
    case Aedat4Compression::zstd_high:
      return zstd_frame(bytes, 19);
  }
  throw std::invalid_argument("compression");
}

std::string aedat4_header(std::int32_t compression, std::int64_t table_position, std::string_view xml) {
  const Slot text = vector_of(xml.size(), std::string(xml) + '\0', 4);
  return "#!AER-DAT4.0\r\n" + flatbuffer("IOHE", {scalar(compression), scalar(table_position), text});
}

void Aedat4File::add(std::int32_t stream, std::string_view buffer) {
  add_stored(stream, aedat4_compressed(buffer, compression_));
}

void Aedat4File::add_stored(std::int32_t stream, std::string_view payload, std::int32_t size) {
  packets_ += number(stream) + number(size);
  packets_ += payload;
}

std::string Aedat4File::bytes(std::optional<std::int64_t> table_position) const {
  const std::string table = aedat4_compressed(flatbuffer("FTAB", {vector_of(0, "", 4)}), compression_);
  return bytes_without_table(table_position.value_or(static_cast<std::int64_t>(position()))) + table;
}

std::string Aedat4File::bytes_without_table(std::int64_t table_position) const {
  return header(table_position) + packets_;
}

std::string Aedat4File::header(std::int64_t table_position) const {
  return aedat4_header(static_cast<std::int32_t>(compression_), table_position, xml_);
}

Aedat4File aedat4_event_file(Aedat4Compression compression, std::string_view size) {
  return {compression, aedat4_xml(aedat4_stream_xml(0, "EVTS", size))};
}

}  // namespace esi::test

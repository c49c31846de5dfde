#include "esi/io/writing/aedat4_encoding.hpp"

#include <aedat4_generated.h>

#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "esi/io/aedat4/header.hpp"

namespace esi {
namespace {

using flatbuffers::FlatBufferBuilder;

Bytes finished(const FlatBufferBuilder& builder) {
  const auto* const data = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {data, data + builder.GetSize()};
}

void add_attribute(pugi::xml_node node, const char* key, const char* type, const std::string& text) {
  pugi::xml_node attribute = node.append_child("attr");
  attribute.append_attribute("key") = key;
  attribute.append_attribute("type") = type;
  attribute.text() = text.c_str();
}

void add_stream(pugi::xml_node out_info, std::int32_t id, const char* output, const char* type,
                const char* description, const WriteOptions& options) {
  const std::string name = std::to_string(id);
  pugi::xml_node node = out_info.append_child("node");
  node.append_attribute("name") = name.c_str();
  node.append_attribute("path") = ("/mainloop/output_file/outInfo/" + name + "/").c_str();
  add_attribute(node, "compression", "string", "LZ4");
  add_attribute(node, "originalModuleName", "string", "camera");
  add_attribute(node, "originalOutputName", "string", output);
  add_attribute(node, "typeDescription", "string", description);
  add_attribute(node, "typeIdentifier", "string", type);
  pugi::xml_node info = node.append_child("node");
  info.append_attribute("name") = "info";
  info.append_attribute("path") = ("/mainloop/output_file/outInfo/" + name + "/info/").c_str();
  add_attribute(info, "sizeX", "int", std::to_string(options.size.width_px));
  add_attribute(info, "sizeY", "int", std::to_string(options.size.height_px));
  add_attribute(info, "source", "string", options.camera_name);
  add_attribute(info, "tsOffset", "long", std::to_string(options.t_offset_us));
}

/// See formats.md section 1.2.
std::string header_xml(const WriteOptions& options) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("dv");
  root.append_attribute("version") = "2.0";
  pugi::xml_node out_info = root.append_child("node");
  out_info.append_attribute("name") = "outInfo";
  out_info.append_attribute("path") = "/mainloop/output_file/outInfo/";
  add_stream(out_info, kAedat4EventStream, "events", "EVTS", "Array of events (polarity ON/OFF).", options);
  add_stream(out_info, kAedat4FrameStream, "frames", "FRME", "Standard frame (8-bit image).", options);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_indent | pugi::format_no_declaration);
  return text.str();
}

}  // namespace

Bytes encode_aedat4_header(const WriteOptions& options, std::int64_t table_position) {
  FlatBufferBuilder builder;
  builder.ForceDefaults(true);  // -1 is the position's default, and would otherwise take no place
  const auto xml = builder.CreateString(header_xml(options));
  builder.FinishSizePrefixed(aedat4::CreateIOHeader(builder, aedat4::Compression::LZ4, table_position, xml),
                             "IOHE");
  const auto magic = std::as_bytes(std::span(kAedat4Magic));
  Bytes header(magic.begin(), magic.end());
  const Bytes buffer = finished(builder);
  header.insert(header.end(), buffer.begin(), buffer.end());
  return header;
}

Bytes encode_aedat4_events(std::span<const Event> events, std::int64_t t_offset_us) {
  FlatBufferBuilder builder;
  aedat4::Event* stored = nullptr;
  const auto elements = builder.CreateUninitializedVectorOfStructs(events.size(), &stored);
  for (const Event& event : events) {
    *stored++ = {event.t_us + t_offset_us, static_cast<std::int16_t>(event.x),
                 static_cast<std::int16_t>(event.y), event.on};
  }
  builder.FinishSizePrefixed(aedat4::CreateEventPacket(builder, elements), "EVTS");
  return finished(builder);
}

// `timestamp` is the start of the exposure, whose length is given besides, as newer recorders do. Readers of
// older files take start and end.
Bytes encode_aedat4_frame(const IntensityFrame& frame, std::int64_t t_offset_us) {
  const cv::Mat image = frame.image.isContinuous() ? frame.image : frame.image.clone();
  const std::int64_t begin_us = frame.exposure.begin_us + t_offset_us;
  const std::int64_t end_us = frame.exposure.end_us + t_offset_us;
  FlatBufferBuilder builder;
  const auto pixels = builder.CreateVector(image.data, image.total() * image.elemSize());
  builder.FinishSizePrefixed(
      aedat4::CreateFrame(builder, begin_us, begin_us, end_us, begin_us, end_us,
                          static_cast<std::int8_t>(image.type()), static_cast<std::int16_t>(image.cols),
                          static_cast<std::int16_t>(image.rows), 0, 0, pixels, end_us - begin_us),
      "FRME");
  return finished(builder);
}

Bytes encode_aedat4_table(std::span<const Aedat4TableRow> rows) {
  FlatBufferBuilder builder;
  std::vector<flatbuffers::Offset<aedat4::FileDataDefinition>> packets;
  packets.reserve(rows.size());
  for (const Aedat4TableRow& row : rows) {
    const aedat4::PacketHeader head(row.stream, row.size);
    packets.push_back(aedat4::CreateFileDataDefinition(builder, row.byte_offset, &head, row.elements,
                                                       row.begin_us, row.end_us));
  }
  builder.FinishSizePrefixed(aedat4::CreateFileDataTable(builder, builder.CreateVector(packets)), "FTAB");
  return finished(builder);
}

Bytes encode_aedat4_packet_head(std::int32_t stream, std::int32_t size) {
  const aedat4::PacketHeader head(stream, size);
  const auto bytes = std::as_bytes(std::span(&head, 1));
  return {bytes.begin(), bytes.end()};
}

}  // namespace esi

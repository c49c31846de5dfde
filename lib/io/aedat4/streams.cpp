#include "esi/io/aedat4/streams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>

#include "esi/core/error.hpp"

namespace esi {
namespace {

// Coordinates are int16.
constexpr int kMaxSide_px = 32768;
// Stereo rigs have some ten.
constexpr std::size_t kMaxStreams = 256;
// Of a name that may come to stand in a message.
constexpr std::size_t kMaxNameBytes = 64;

std::optional<int> integer_in(std::string_view text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || text.empty()) return std::nullopt;
  return value;
}

std::string_view attribute(pugi::xml_node node, const char* key) {
  return node.find_child_by_attribute("attr", "key", key).child_value();
}

std::optional<SensorSize> size_in(pugi::xml_node info) {
  const int width = integer_in(attribute(info, "sizeX")).value_or(0);
  const int height = integer_in(attribute(info, "sizeY")).value_or(0);
  if (width < 1 || height < 1 || width > kMaxSide_px || height > kMaxSide_px) return std::nullopt;
  return SensorSize{width, height};
}

/// Fit for a message of one line.
std::string name_in(pugi::xml_node node, const char* key) {
  std::string name(attribute(node, key).substr(0, kMaxNameBytes));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  return name;
}

std::size_t line_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

}  // namespace

std::string Aedat4Stream::text() const {
  return fmt::format("{}: {}{}{}", id, type.empty() ? "unknown" : type, size ? " " + to_string(*size) : "",
                     source.empty() ? "" : " " + source);
}

// <dv><node name="outInfo"><node name="ID"><attr key="typeIdentifier">EVTS</attr>... <node name="info">...
std::vector<Aedat4Stream> parse_aedat4_streams(std::string_view xml, const std::string& name) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml.data(), xml.size());
  if (!parsed) {
    throw Error(fmt::format("{}: the header's XML, line {}: {}; the file is damaged", name,
                            line_of(xml, static_cast<std::size_t>(parsed.offset)), parsed.description()));
  }
  std::vector<Aedat4Stream> streams;
  const pugi::xml_node out_info = document.child("dv").find_child_by_attribute("node", "name", "outInfo");
  for (const pugi::xml_node node : out_info.children("node")) {
    const auto id = integer_in(node.attribute("name").value());
    if (!id) continue;
    const pugi::xml_node info = node.find_child_by_attribute("node", "name", "info");
    streams.push_back({*id, name_in(node, "typeIdentifier"), name_in(info, "source"), size_in(info)});
  }
  if (streams.empty() || streams.size() > kMaxStreams) {
    throw Error(
        fmt::format("{}: the header's XML lists {} streams, but 1 to {} are possible; the file is damaged",
                    name, streams.size(), kMaxStreams));
  }
  return streams;
}

}  // namespace esi

#include "esi/io/prophesee/raw_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/io/prophesee/header_lines.hpp"

namespace esi {
namespace {

/// The value of `key` in a format line, "EVT3;height=720;width=1280"; empty where it is not there.
std::string_view format_option(std::string_view format, std::string_view key) {
  while (!format.empty()) {
    const std::string_view option = format.substr(0, format.find(';'));
    format.remove_prefix(std::min(option.size() + 1, format.size()));
    const std::size_t equals = option.find('=');
    if (equals != std::string_view::npos && option.substr(0, equals) == key) return option.substr(equals + 1);
  }
  return {};
}

std::string_view encoding_of_version(std::string_view evt) {
  if (evt == "2.0") return "EVT2";
  if (evt == "2.1") return "EVT21";
  if (evt == "3.0") return "EVT3";
  return {};
}

/// "EVT2", "EVT21", "EVT3", or what else the header says.
std::string encoding_in(const PropheseeHeaderLines& header, const std::string& name) {
  const auto format = header.find("format");
  if (format) return std::string(shortened(format->substr(0, format->find(';'))));
  const auto evt = header.find("evt");
  if (!evt) {
    throw Error(fmt::format(
        "{}: the header (its first {} bytes) has neither a line \"% evt\" nor \"% format\", which "
        "name the encoding of the events; the file is damaged or of an unknown camera",
        name, header.bytes));
  }
  const std::string_view encoding = encoding_of_version(*evt);
  return std::string(encoding.empty() ? shortened(*evt) : encoding);
}

Evt21Decoder::HalfOrder half_order(const PropheseeHeaderLines& header) {
  const bool is_legacy = format_option(header.find("format").value_or(""), "endianness") == "legacy" ||
                         header.find("endianness") == "legacy";
  return is_legacy ? Evt21Decoder::HalfOrder::high_first : Evt21Decoder::HalfOrder::low_first;
}

std::optional<SensorSize> declared_size(const PropheseeHeaderLines& header) {
  const std::string_view format = header.find("format").value_or("");
  const auto size = sensor_size_from(format_option(format, "width"), format_option(format, "height"));
  if (size) return size;
  const std::string_view geometry = header.find("geometry").value_or("");
  const std::size_t cross = geometry.find('x');
  if (cross == std::string_view::npos) return std::nullopt;
  return sensor_size_from(geometry.substr(0, cross), geometry.substr(cross + 1));
}

/// Of the cameras whose size is known by their number (formats.md section 6).
std::optional<SensorSize> size_of_system(std::string_view system_id) {
  if (system_id == "21") return SensorSize{640, 480};   // Gen3
  if (system_id == "48") return SensorSize{1280, 720};  // Gen4.1, EVK3
  return std::nullopt;
}

}  // namespace

PropheseeRawHeader read_raw_header(ByteWindow& bytes) {
  const PropheseeHeaderLines lines = peek_prophesee_header(bytes);
  const std::string encoding = encoding_in(lines, bytes.name());
  auto decoder = EvtDecoder::of(encoding, half_order(lines));
  if (!decoder) {
    throw Error(fmt::format(
        "{}: the header says that the events are encoded as '{}', but EVT2, EVT21 and EVT3 (evt 2.0, 2.1 and "
        "3.0) are known; convert it with Metavision",
        bytes.name(), encoding));
  }
  PropheseeRawHeader header{*decoder, encoding, declared_size(lines), {}};
  const std::string_view system_id = lines.find("system_ID").value_or("");
  if (!header.sensor) {
    header.sensor = size_of_system(system_id);
    if (header.sensor) {
      header.notes.push_back(
          fmt::format("The header has no sensor size; {} is that of the camera, system_ID {}.",
                      to_string(*header.sensor), system_id));
    }
  }
  bytes.skip(lines.bytes);
  return header;
}

}  // namespace esi

#include "esi/io/aedat3/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "esi/core/error.hpp"
#include "esi/io/aedat_line.hpp"
#include "esi/io/camera_chip.hpp"

namespace esi {
namespace {

constexpr std::size_t kMaxSources = 256;
// Of a name that may come to stand in a message.
constexpr std::size_t kMaxNameBytes = 128;
// Coordinates have 15 bits.
constexpr int kMaxSide_px = 32768;

std::optional<int> integer_at(std::string_view text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

/// Of "key=VALUE,key=VALUE"; 0 where the key is missing.
int number_in(std::string_view text, std::string_view key) {
  const std::size_t found = text.find(key);
  return found == std::string_view::npos ? 0 : integer_at(text.substr(found + key.size())).value_or(0);
}

/// A module that repeats events of a file, the network or another module gives sizes instead of a chip.
std::optional<SensorSize> declared_size(std::string_view name) {
  const SensorSize size{number_in(name, "dvsSizeX="), number_in(name, "dvsSizeY=")};
  const bool is_possible = size.width_px > 0 && size.height_px > 0 && size.width_px <= kMaxSide_px &&
                           size.height_px <= kMaxSide_px;
  return is_possible ? std::optional(size) : std::nullopt;
}

/// Of "1: DAVIS240C"
Aedat3Source source_in(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::size_t begin = std::min(text.find_first_not_of(": ", colon), text.size());
  Aedat3Source source;
  source.id = integer_at(text).value_or(-1);
  source.name = text.substr(begin, kMaxNameBytes);
  const CameraChip* const chip = find_camera_chip(source.name);
  source.size = chip != nullptr ? std::optional(chip->size) : declared_size(source.name);
  source.has_frames = chip != nullptr ? chip->is_davis : number_in(source.name, "apsSizeX=") > 0;
  return source;
}

void check_version(const std::string& line, const std::string& name) {
  if (line == "#!AER-DAT3.1") return;
  throw Error(
      fmt::format("{}: it is AEDAT {}, of which only 3.1 is read; replay it in cAER and record it as 3.1",
                  name, line.substr(kAedat3Magic.size() - 2, 8)));
}

void check_format(const std::string& format, const std::string& name) {
  if (format == "RAW") return;
  throw Error(
      fmt::format("{}: its packets are compressed (format {}), and only RAW is read; replay it in cAER and "
                  "record it as RAW",
                  name, format.substr(0, kMaxNameBytes)));
}

std::string sources_text(const Aedat3Header& header) {
  std::string text;
  for (const Aedat3Source& source : header.sources) text += (text.empty() ? "" : ", ") + source.text();
  return text;
}

}  // namespace

std::string Aedat3Source::text() const {
  return fmt::format("{}: {}{}", id, name, size ? " " + to_string(*size) : "");
}

const Aedat3Source* Aedat3Header::find(int id) const {
  const auto found =
      std::find_if(sources.begin(), sources.end(), [id](const Aedat3Source& s) { return s.id == id; });
  return found == sources.end() ? nullptr : &*found;
}

Aedat3Header read_aedat3_header(ByteWindow& bytes) {
  Aedat3Header header;
  const auto version = take_aedat_line(bytes);
  if (version) check_version(*version, bytes.name());
  for (auto line = version; line != "#!END-HEADER"; line = take_aedat_line(bytes)) {
    if (!line || header.sources.size() > kMaxSources) {
      throw Error(
          fmt::format("{}: the header at byte {} has no line #!END-HEADER where it ends; the file is damaged",
                      bytes.name(), bytes.position()));
    }
    if (const auto format = value_in_aedat_line(*line, "#Format:")) check_format(*format, bytes.name());
    if (const auto source = value_in_aedat_line(*line, "#Source ")) {
      header.sources.push_back(source_in(*source));
    }
  }
  return header;
}

std::optional<Aedat3Source> select_aedat3_source(const Aedat3Header& header, const ReadOptions& options,
                                                 const std::string& name) {
  if (!options.stream.empty()) {
    const auto id = integer_at(options.stream);
    const Aedat3Source* const wanted =
        id && std::to_string(*id) == options.stream ? header.find(*id) : nullptr;
    if (wanted != nullptr) return *wanted;
    throw usage_error(fmt::format("{}: '{}' is none of its sources; give --stream the number of one: {}",
                                  name, options.stream, sources_text(header)));
  }
  std::vector<Aedat3Source> cameras;
  std::copy_if(header.sources.begin(), header.sources.end(), std::back_inserter(cameras),
               [](const Aedat3Source& source) { return source.size.has_value(); });
  if (cameras.empty()) cameras = header.sources;
  if (cameras.size() > 1) {
    throw usage_error(
        fmt::format("{}: there are several sources; choose one with --stream and its number: {}", name,
                    sources_text(header)));
  }
  return cameras.empty() ? std::nullopt : std::optional(cameras.front());
}

}  // namespace esi

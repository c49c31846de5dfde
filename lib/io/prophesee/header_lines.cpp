#include "esi/io/prophesee/header_lines.hpp"

#include <algorithm>
#include <charconv>

namespace esi {
namespace {

// Real headers have some 500 bytes.
constexpr std::size_t kFirstBytes = 4096;
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxLineBytes = 4096;
constexpr std::size_t kMessageBytes = 64;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Not isprint: the locale must not matter. Bytes beyond ASCII are those of UTF-8, which has none above 0xF4.
bool is_text(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return c == '\t' || (byte >= ' ' && byte != 0x7F && byte <= 0xF4);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

constexpr std::string_view kShortestLine = "% k";

/// Whether these may be the first bytes of a line.
bool may_begin_line(std::string_view start) {
  return (start.empty() || start[0] == '%') && (start.size() < 2 || start[1] == ' ') &&
         (start.size() < 3 || is_letter(start[2])) && std::all_of(start.begin(), start.end(), is_text);
}

PropheseeHeaderLines::Line parsed(std::string_view line) {
  line = trimmed(line.substr(1));
  const std::size_t blank = std::min(line.find_first_of(" \t"), line.size());
  return {line.substr(0, blank), trimmed(line.substr(blank))};
}

}  // namespace

PropheseeHeaderLines PropheseeHeaderLines::in(std::span<const std::byte> head) {
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  PropheseeHeaderLines header;
  while (!header.is_complete) {
    const std::string_view rest = text.substr(header.bytes, kMaxLineBytes);
    const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
    const std::size_t line_feed = rest.find('\n', line.size());
    const bool has_end = line_feed != std::string_view::npos && line_feed <= line.size() + 1;
    if (!may_begin_line(line) || (has_end && line.size() < kShortestLine.size())) {
      header.is_complete = true;
    } else if (!has_end) {
      header.is_complete = rest.size() == kMaxLineBytes || rest.size() > line.size() + 1;
      break;
    } else {
      header.bytes += line_feed + 1;
      header.lines.push_back(parsed(line));
      header.is_complete = line == "% end";
    }
  }
  return header;
}

std::optional<std::string_view> PropheseeHeaderLines::find(std::string_view key) const {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [key](const Line& line) { return line.key == key; });
  if (found == lines.end()) return std::nullopt;
  return found->value;
}

PropheseeHeaderLines peek_prophesee_header(ByteWindow& bytes) {
  for (std::size_t wanted = kFirstBytes;; wanted *= 2) {
    const auto head = bytes.peek(wanted);
    PropheseeHeaderLines header = PropheseeHeaderLines::in(head);
    if (header.is_complete || head.size() < wanted || wanted >= kMaxHeaderBytes) return header;
  }
}

std::optional<SensorSize> sensor_size_from(std::string_view width, std::string_view height) {
  const auto side = [](std::string_view text) {
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end && value <= kMaxSensorSide_px ? value : 0;
  };
  const SensorSize size{side(width), side(height)};
  if (size.width_px < 1 || size.height_px < 1) return std::nullopt;
  return size;
}

std::string_view shortened(std::string_view text) { return text.substr(0, kMessageBytes); }

}  // namespace esi

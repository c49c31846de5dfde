#include "esi/io/aedat_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "esi/core/error.hpp"

namespace esi {
namespace {

// jAER writes all its preferences into the header: 175 KB have been seen.
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 24;
constexpr std::size_t kFirstPeekBytes = 256;

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Bytes of 0x80 and more may be letters of any encoding.
bool is_text(char c) { return static_cast<unsigned char>(c) >= ' ' ? c != 0x7F : c == '\t'; }

/// The next bytes as far as they are text, and up to two of those behind.
std::string_view peek_text_line(ByteWindow& bytes) {
  std::size_t seen = 0;
  for (std::size_t wanted = kFirstPeekBytes;; wanted *= 2) {
    const std::string_view text = text_of(bytes.peek(wanted));
    const auto* const end = std::find_if_not(text.data() + seen, text.data() + text.size(), is_text);
    seen = static_cast<std::size_t>(end - text.data());
    if (bytes.position() + seen > kMaxHeaderBytes) {
      throw Error(fmt::format("{}: its header has more than {} bytes, which can't be; the file is damaged",
                              bytes.name(), kMaxHeaderBytes));
    }
    const bool is_told = seen + 1 < text.size() || (seen < text.size() && *end != '\r');
    if (is_told) return text.substr(0, seen + 2);
    if (text.size() < wanted) {
      throw Error(fmt::format("{}: the file ends within its header, at byte {}; copy it again", bytes.name(),
                              bytes.position() + text.size()));
    }
  }
}

}  // namespace

std::optional<std::string> take_aedat_line(ByteWindow& bytes) {
  const std::string_view first = text_of(bytes.peek(1));
  if (first != "#") return std::nullopt;
  const std::string_view line = peek_text_line(bytes);
  if (!line.ends_with("\r\n")) return std::nullopt;
  std::string result(line.substr(0, line.size() - 2));
  bytes.skip(line.size());
  return result;
}

std::optional<std::string> value_in_aedat_line(const std::string& line, std::string_view key) {
  if (!line.starts_with(key)) return std::nullopt;
  const std::size_t begin = line.find_first_not_of(' ', key.size());
  if (begin == std::string::npos) return "";
  return line.substr(begin, line.find_last_not_of(' ') + 1 - begin);
}

}  // namespace esi

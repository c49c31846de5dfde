#include "esi/io/text/kind.hpp"

#include <algorithm>
#include <string_view>

#include "esi/io/text/reader.hpp"

namespace esi {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view bytes;  // at the beginning
  std::string_view description;
};

// Longer ones before their own beginnings: UTF-32 begins as UTF-16 does.
constexpr Signature kSignatures[] = {
    {"\x1f\x8b"sv, "it is compressed with gzip; unpack it first (gunzip)"},
    {"PK\x03\x04"sv, "it is a zip archive; unpack it first (unzip)"},
    {"\x28\xb5\x2f\xfd"sv, "it is compressed with zstd; unpack it first (unzstd)"},
    {"\xfd\x37zXZ\0"sv, "it is compressed with xz; unpack it first (unxz)"},
    {"BZh"sv, "it is compressed with bzip2; unpack it first (bunzip2)"},
    {"7z\xbc\xaf\x27\x1c"sv, "it is a 7z archive; unpack it first"},
    {"\xff\xfe\0\0"sv, "it is UTF-32 text; convert it first (iconv -f UTF-32 -t UTF-8)"},
    {"\0\0\xfe\xff"sv, "it is UTF-32 text; convert it first (iconv -f UTF-32 -t UTF-8)"},
    {"\xff\xfe"sv, "it is UTF-16 text; convert it first (iconv -f UTF-16 -t UTF-8)"},
    {"\xfe\xff"sv, "it is UTF-16 text; convert it first (iconv -f UTF-16 -t UTF-8)"},
    {"#!AER-DAT"sv, "it is an AEDAT recording"},
};

std::string_view characters(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_control(char c) {
  const bool is_space = c == '\t' || c == '\n' || c == '\r';
  return (static_cast<unsigned char>(c) < ' ' && !is_space) || c == '\x7f';
}

bool is_beyond_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

// Every second byte is zero: ASCII characters in UTF-16 without a byte order mark.
bool looks_like_utf16(std::string_view head) {
  if (head.size() < 4) return false;
  const auto zeros = [head](std::size_t first) {
    std::size_t n = 0;
    for (std::size_t i = first; i < head.size(); i += 2) n += head[i] == '\0' ? 1 : 0;
    return n;
  };
  const std::size_t half = head.size() / 2;
  return (zeros(0) == 0 && zeros(1) == half) || (zeros(1) == 0 && zeros(0) >= half);
}

// Letters beyond ASCII are for comments, in whatever encoding.
bool is_plain_text(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  if (std::any_of(head.begin(), head.end(), is_control)) return false;
  while (!head.empty()) {
    const std::string_view line = head.substr(0, head.find('\n'));
    const bool is_comment = line.starts_with('#') || line.starts_with('%');
    if (!is_comment && std::any_of(line.begin(), line.end(), is_beyond_ascii)) return false;
    head.remove_prefix(std::min(head.size(), line.size() + 1));
  }
  return true;
}

}  // namespace

std::string describe_non_text(std::span<const std::byte> head) {
  const std::string_view text = characters(head);
  if (text.empty()) return "it is empty";
  for (const auto& [bytes, description] : kSignatures) {
    if (text.starts_with(bytes)) return std::string(description);
  }
  if (looks_like_utf16(text)) return "it is UTF-16 text; convert it first (iconv -f UTF-16LE -t UTF-8)";
  return is_plain_text(text) ? "" : "it is binary, not text";
}

bool looks_like_text(std::span<const std::byte> head) { return describe_non_text(head).empty(); }

}  // namespace esi

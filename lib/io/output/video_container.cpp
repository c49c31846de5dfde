#include "esi/io/output/video_container.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace esi {
namespace {

constexpr std::size_t kHeadBytes = 16;
using Head = std::array<std::uint8_t, kHeadBytes>;

std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

bool begins_with(const Head& head, std::string_view id) {
  return std::memcmp(head.data(), id.data(), id.size()) == 0;
}

/// AVI: "RIFF", little-endian length of what follows; several of them above 1 GiB.
std::uint64_t riff_length(const Head& head) {
  return 8 + (std::uint64_t{head[4]} | std::uint64_t{head[5]} << 8 | std::uint64_t{head[6]} << 16 |
              std::uint64_t{head[7]} << 24);
}

/// Matroska (EBML): an id of four bytes here, then the length of what follows in 1 to 8 bytes, whose leading
/// zero bits tell how many. All ones stand for a length that is not known.
std::optional<std::uint64_t> ebml_length(const Head& head) {
  std::size_t bytes = 1;
  while (bytes <= 8 && (head[4] >> (8 - bytes) & 1) == 0) ++bytes;
  if (bytes > 8) return std::nullopt;
  const std::uint64_t unknown = (std::uint64_t{1} << 7 * bytes) - 1;
  const std::uint64_t length = big_endian(std::span(head).subspan(4, bytes)) & unknown;
  if (length == unknown) return std::nullopt;
  return 4 + bytes + length;
}

/// MP4: big-endian length of the whole box and its name; length 1 stands for 64 bits behind the name. A
/// length of 0 ("to the end of the file") is what a writer leaves that didn't come to its end.
std::optional<std::uint64_t> box_length(const Head& head) {
  const std::uint64_t length = big_endian(std::span(head).first(4));
  const std::uint64_t whole = length == 1 ? big_endian(std::span(head).subspan(8, 8)) : length;
  if (whole < 8) return std::nullopt;
  return whole;
}

std::optional<std::uint64_t> length_of(const Head& head) {
  if (begins_with(head, "RIFF")) return riff_length(head);
  if (begins_with(head, "\x1a\x45\xdf\xa3") || begins_with(head, "\x18\x53\x80\x67"))
    return ebml_length(head);
  return box_length(head);
}

}  // namespace

bool is_whole_video(const std::filesystem::path& path) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) return false;
  std::uint64_t position = 0;
  while (position < size) {
    Head head{};
    file.clear();
    file.seekg(static_cast<std::streamoff>(position));
    file.read(reinterpret_cast<char*>(head.data()), kHeadBytes);
    const auto length = length_of(head);
    if (!length || *length > size - position) return false;
    position += *length;
  }
  return size > 0;
}

}  // namespace esi

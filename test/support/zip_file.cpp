#include "support/zip_file.hpp"

#include <zlib.h>

#include <stdexcept>

namespace esi::test {
namespace {

std::string little_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

std::string deflated(const std::string& content) {
  z_stream stream{};
  constexpr int kRawDeflate = -15;
  deflateInit2(&stream, 6, Z_DEFLATED, kRawDeflate, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int code = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (code != Z_STREAM_END) throw std::runtime_error("the test's own archive cannot be deflated");
  return packed;
}

/// What stands both before the file and in the directory: flags, method, time, date, CRC, sizes.
std::string description(const ZipEntry& entry, const std::string& stored) {
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(entry.content.data()), entry.content.size());
  return little_endian(20, 2) + little_endian(entry.is_encrypted ? 1 : 0, 2) +
         little_endian(entry.is_deflated ? 8 : 0, 2) + little_endian(0, 2) + little_endian(0x5A21, 2) +
         little_endian(crc + entry.checksum_error, 4) + little_endian(stored.size(), 4) +
         little_endian(entry.content.size(), 4) + little_endian(entry.name.size(), 2) + little_endian(0, 2);
}

}  // namespace

std::string zip_archive(const std::vector<ZipEntry>& entries) {
  std::string files, directory;
  for (const ZipEntry& entry : entries) {
    const std::string stored = entry.is_deflated ? deflated(entry.content) : entry.content;
    directory += "PK\x01\x02" + little_endian(20, 2) + description(entry, stored) +
                 little_endian(0, 2 + 2 + 2) + little_endian(0, 4) + little_endian(files.size(), 4) +
                 entry.name;
    files += "PK\x03\x04" + description(entry, stored) + entry.name + stored;
  }
  const std::size_t count = entries.size();
  return files + directory + "PK\x05\x06" + little_endian(0, 4) + little_endian(count, 2) +
         little_endian(count, 2) + little_endian(directory.size(), 4) + little_endian(files.size(), 4) +
         little_endian(0, 2);
}

}  // namespace esi::test

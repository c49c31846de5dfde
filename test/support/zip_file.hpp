#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace esi::test {

/// A file in an archive under construction.
struct ZipEntry {
  std::string name;
  std::string content;
  bool is_deflated = true;
  bool is_encrypted = false;         ///< only says so
  std::uint32_t checksum_error = 0;  ///< added to the content's CRC-32
};

/// A zip archive laid out by hand.
std::string zip_archive(const std::vector<ZipEntry>& entries);

}  // namespace esi::test

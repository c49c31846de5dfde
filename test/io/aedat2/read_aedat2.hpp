#pragma once

#include <filesystem>
#include <string>

#include "esi/core/error.hpp"
#include "esi/io/aedat2/reader.hpp"
#include "support/aedat2_file.hpp"
#include "support/read_format.hpp"

namespace esi::test {

inline FormatReading read_aedat2(const std::filesystem::path& path, const ReadOptions& options = {}) {
  return read_with(open_aedat2, path, options);
}

/// Of a file with these bytes.
inline FormatReading read_aedat2_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  return read_bytes_with(open_aedat2, bytes, options);
}

/// "usage: ..." or "failure: ...": what a file with these bytes is refused with.
inline std::string aedat2_refusal(const std::string& bytes, const ReadOptions& options = {}) {
  try {
    read_aedat2_bytes(bytes, options);
  } catch (const Error& error) {
    return (error.kind() == Error::Kind::usage ? "usage: " : "failure: ") + std::string(error.what());
  }
  return "no error";
}

inline ReadOptions with_chip(const std::string& chip, const std::string& size = "") {
  ReadOptions options;
  options.chip = chip;
  options.size = size;
  return options;
}

}  // namespace esi::test

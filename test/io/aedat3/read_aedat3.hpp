#pragma once

#include <filesystem>
#include <string>

#include "esi/core/error.hpp"
#include "esi/io/aedat3/reader.hpp"
#include "support/aedat3_file.hpp"
#include "support/read_format.hpp"

namespace esi::test {

inline FormatReading read_aedat3(const std::filesystem::path& path, const ReadOptions& options = {}) {
  return read_with(open_aedat3, path, options);
}

/// Of a file with these bytes.
inline FormatReading read_aedat3_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  return read_bytes_with(open_aedat3, bytes, options);
}

/// "usage: ..." or "failure: ...": what a file with these bytes is refused with.
inline std::string aedat3_refusal(const std::string& bytes, const ReadOptions& options = {}) {
  try {
    read_aedat3_bytes(bytes, options);
  } catch (const Error& error) {
    return (error.kind() == Error::Kind::usage ? "usage: " : "failure: ") + std::string(error.what());
  }
  return "no error";
}

/// Of one DAVIS240C, source 1.
inline std::string aedat3_davis_header() { return aedat3_header("#Source 1: DAVIS240C\r\n"); }

/// `count` events from t_us on, 10 us apart, within 240x180.
inline std::vector<Event> some_aedat3_events(std::int64_t t_us, int count) {
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    events.push_back({t_us + 10 * std::int64_t{i}, static_cast<std::uint16_t>(i * 7 % 240),
                      static_cast<std::uint16_t>(i * 11 % 180), i % 3 == 0});
  }
  return events;
}

}  // namespace esi::test

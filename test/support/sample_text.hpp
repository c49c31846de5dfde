#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <string>

namespace esi::test {

/// An RPG text recording of one event every `step_us`, on a 12x9 sensor, ON and OFF.
inline std::string sample_text(std::int64_t events, std::int64_t step_us, std::int64_t width = 12,
                               std::int64_t height = 9) {
  std::string text;
  for (std::int64_t i = 0; i < events; ++i) {
    const std::int64_t t_us = i * step_us;
    fmt::format_to(std::back_inserter(text), "{}.{:06} {} {} {}\n", t_us / 1000000, t_us % 1000000,
                   i * 7 % width, i * 5 % height, i % 3 == 0 ? 0 : 1);
  }
  return text;
}

}  // namespace esi::test

#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <string_view>

#include "esi/core/error.hpp"
#include "io/text/read_text.hpp"

namespace esi::test {

/// `count` good lines, 1 ms apart from t = 0 on, one of them in every way the fast path knows.
inline std::string good_lines(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += fmt::format("{}.{:03} {} {} {}\n", i / 1000, i % 1000, i % 346, i % 260, i % 2);
  return text;
}

inline std::string message_of(std::string_view text, const ReadOptions& options = {}) {
  try {
    const TextContent content = read_text(text, options);
    return fmt::format("no error, but {} events", content.events.size());
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::failure);
    return error.what();
  }
}

}  // namespace esi::test

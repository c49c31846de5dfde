#include "esi/io/times_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {

std::vector<std::int64_t> read_times(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  std::vector<std::int64_t> times_us;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    double t_s = 0;
    const auto parsed = std::from_chars(line.data(), line.data() + line.size(), t_s);
    const bool ends_well = parsed.ptr == line.data() + line.size() || *parsed.ptr == ' ' ||
                           *parsed.ptr == '\t' || *parsed.ptr == '\r';
    if (parsed.ec != std::errc{} || !ends_well || !std::isfinite(t_s)) {
      throw usage_error(
          fmt::format("{}: line {} does not begin with a time in seconds", path.string(), line_number));
    }
    const std::int64_t t_us = us_from_seconds(t_s);
    if (!times_us.empty() && t_us < times_us.back()) {
      throw usage_error(fmt::format("{}: line {} is earlier than the line before; sort the times",
                                    path.string(), line_number));
    }
    times_us.push_back(t_us);
  }
  if (times_us.empty()) throw usage_error(path.string() + ": there are no times in it");
  return times_us;
}

}  // namespace esi

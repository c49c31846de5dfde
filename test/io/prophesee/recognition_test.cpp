// RAW, DAT and text files may all begin with '%'.
#include <catch2/catch.hpp>

#include "esi/io/format_reader.hpp"
#include "support/prophesee_file.hpp"

namespace esi::test {
namespace {

std::string recognised_as(const std::string& bytes) {
  const auto head = std::as_bytes(std::span(bytes)).first(std::min(bytes.size(), kFormatHeadBytes));
  for (const Format& format : formats()) {
    if (format.recognises(head)) return std::string(format.name);
  }
  return "";
}

}  // namespace

TEST_CASE("files that begin with a percent sign are told apart by their first bytes") {
  using namespace std::string_literals;
  const std::vector<Event> events = {{1000, 10, 20, true}, {2000, 11, 20, false}};
  const auto [what, bytes] = GENERATE_COPY(table<const char*, std::string>({
      {"prophesee-raw", evt2_recording(events)},
      {"prophesee-raw", evt21_recording(events)},
      {"prophesee-raw", evt3_recording(events)},
      {"prophesee-raw", prophesee_lines({"Date 2020", "evt 9.9"}) + "\x01\x80"},
      {"prophesee-raw", prophesee_lines({"Date 2020", "serial_number 1", "Version 2"}) + "\x01\x80"},
      {"prophesee-raw", prophesee_lines({"evt 3.0"})},
      {"prophesee-raw", prophesee_lines({"evt 3.0"}) + "% and a line that is cut"},
      {"prophesee-raw", prophesee_lines({"evt 3.0"}) + "\x0c\x08"},
      {"prophesee-dat", dat_recording(events)},
      {"prophesee-dat", prophesee_lines({"Data file containing Event2d events."})},
      {"prophesee-dat", prophesee_lines({"Data file containing CD events."}) + "\x11\x22"},
      {"prophesee-dat", prophesee_lines({"Version 2"}) + "\x0e\x08"},
      {"prophesee-dat", prophesee_lines({"Version 2"}) + "\0\x08"s},
      {"text", "%geometry:1280,720\n1,2,1,100\n"},
      {"text", prophesee_lines({"Version 2", "format t x y p"}) + "0.1 2 3 1\n"},
      {"text", prophesee_lines({"a comment about evt 3.0"}) + "0.1 2 3 1\n"},
      {"text", "% 3.0\n0.1 2 3 1\n"},
      {"text", "%evt 3.0\n0.1 2 3 1\n"},
      {"", prophesee_lines({"Version 2"}) + "\x0c\x09"},
      {"", "%\0"s},
  }));
  CAPTURE(bytes);
  CHECK(recognised_as(bytes) == what);
}

}  // namespace esi::test

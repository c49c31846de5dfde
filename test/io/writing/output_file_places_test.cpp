#include "esi/io/output/output_file.hpp"

#include <catch2/catch.hpp>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using esi::OutputFile;
using esi::test::content_of;
using esi::test::TempFolder;

namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

}  // namespace

TEST_CASE("A file can be written and read back at any place, and write goes on where it was") {
  const TempFolder folder;
  OutputFile file(folder / "a");
  file.write("0123");
  file.write_at(1, bytes_of("xy"));
  file.write("45");
  file.write_at(8, bytes_of("89"));
  std::string found(5, '-');
  CHECK(file.read_at(0, std::as_writable_bytes(std::span(found))) == 5);
  CHECK(found == "0xy34");
  CHECK(file.read_at(7, std::as_writable_bytes(std::span(found))) == 3);
  CHECK(found == std::string("\0"
                             "8934",
                             5));
  CHECK(file.read_at(100, std::as_writable_bytes(std::span(found))) == 0);
  file.resize(9);
  file.commit();
  CHECK(content_of(folder / "a") == std::string("0xy345\0\0"
                                                "8",
                                                9));
}

TEST_CASE("A write that fails at any place names the file and the reason") {
  const TempFolder folder;
  OutputFile file(folder / "a");
  const esi::test::FileSizeLimit limit(1000);
  CHECK_NOTHROW(file.write_at(990, bytes_of("0123456789")));
  CHECK_THROWS_WITH(file.write_at(991, bytes_of("0123456789")), Catch::Contains("File too large"));
  CHECK_THROWS_WITH(file.resize(1001), Catch::Contains("File too large"));
}

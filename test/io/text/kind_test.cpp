#include "esi/io/text/kind.hpp"

#include <catch2/catch.hpp>
#include <string_view>

#include "esi/io/text/reader.hpp"

namespace esi::test {

using namespace std::string_view_literals;

TEST_CASE("Text is told from what is not, and what is not is named") {
  struct Row {
    std::string_view bytes, named;
  };
  const Row row = GENERATE(values<Row>({
      {"0.1 2 3 1\r\n"sv, ""},
      {"\xEF\xBB\xBFt,x,y,p\n1,2,3,1\n"sv, ""},
      {"# Zeit in \xC2\xB5s\n0.1 2 3 1\n"sv, ""},
      {"# Latin-1: \xB5s\n0.1 2 3 1\n"sv, ""},
      {"%geometry:3,4\n1\t2\t3\t4"sv, ""},
      {"5"sv, ""},
      {"hello"sv, ""},
      {""sv, "it is empty"},
      {"\x1f\x8b\x08\0\0"sv, "gzip"},
      {"PK\x03\x04\x14\0"sv, "zip archive"},
      {"\x28\xb5\x2f\xfd\x04"sv, "zstd"},
      {"\xfd\x37zXZ\0\0"sv, "xz"},
      {"BZh91AY&SY"sv, "bzip2"},
      {"\xff\xfe\x30\0.\0\x31\0"sv, "UTF-16"},
      {"\xfe\xff\0\x30\0."sv, "UTF-16"},
      {"0\0.\0001\0 \0"sv, "UTF-16"},
      {"\0000\0.\0001\0 "sv, "UTF-16"},
      {"\xff\xfe\0\0\x30\0\0\0"sv, "UTF-32"},
      {"0.1 2 3 1\n\0\0\0\0\1\2"sv, "binary"},
      {"0.1 2 3 1\n\x7f"sv, "binary"},
      {"0.1 2 3 1\n\xC2\xB5\n"sv, "binary"},
      {"\x89HDF\r\n\x1a\n"sv, "binary"},
      {"#!AER-DAT2.0\r\n# This is a raw AE data file\r\n"sv, "AEDAT"},
  }));
  const auto head = std::as_bytes(std::span(row.bytes));
  INFO(row.bytes << " is " << row.named);
  if (row.named.empty()) {
    CHECK(describe_non_text(head).empty());
  } else {
    CHECK_THAT(describe_non_text(head), Catch::Contains(std::string(row.named)));
  }
  CHECK(looks_like_text(head) == row.named.empty());
}

}  // namespace esi::test

#include "esi/io/output/video_container.hpp"

#include <catch2/catch.hpp>

#include "support/temp_folder.hpp"

using namespace std::string_literals;

TEST_CASE("A container is whole when its outermost lengths add up to the file") {
  const std::string zeros(300, '\0');
  // AVI: RIFF, length in little endian; a second RIFF follows the first gigabyte.
  const std::string riff = "RIFF\x10\x01\0\0AVI "s + zeros.substr(0, 0x10c);
  const std::string riff_of_more = "RIFF\x08\0\0\0AVIX1234"s;
  // MP4: length in big endian with its own eight bytes, name; length 1 is followed by one of 64 bits.
  const std::string box =
      "\0\0\0\x0c"
      "ftypisom"s;
  const std::string wide_box =
      "\0\0\0\x01mdat\0\0\0\0\0\0\0\x14"
      "data"s;
  // Matroska: id, length in 1 to 8 bytes (here 1, then 2, then 8), whose first one bit ends the count of
  // bytes.
  const std::string ebml =
      "\x1a\x45\xdf\xa3\x83"
      "abc"s;
  const std::string segment_2 = "\x18\x53\x80\x67\x41\x2c"s + zeros;
  const std::string segment_8 = "\x18\x53\x80\x67\x01\0\0\0\0\0\0\x02xy"s;
  const std::string never_filled_in =
      "\x18\x53\x80\x67\x01\xff\xff\xff\xff\xff\xff\xff"
      "xy"s;

  const esi::test::TempFolder folder;
  const auto is_whole = [&](const std::string& bytes) {
    return esi::is_whole_video(folder.write("video", bytes));
  };
  for (const std::string& whole :
       {riff, riff + riff_of_more, box + wide_box, wide_box + box, ebml + segment_2, ebml + segment_8}) {
    CHECK(is_whole(whole));
    CHECK_FALSE(is_whole(whole.substr(0, whole.size() - 1)));
    CHECK_FALSE(is_whole(whole + '\0'));
  }
  for (const std::string& broken :
       {""s, ebml + never_filled_in, "RIFF\0\0\0\0AVI "s + zeros, box + "\0\0\0\0mdat1234"s,
        "\0\0\0\x01mdat\xff\xff\xff\xff\xff\xff\xff\xff"s, "\x1a\x45\xdf\xa3\0\0\0\0"s + zeros,
        "\x18\x53\x80\x67\xff"s + zeros.substr(0, 127)}) {
    CHECK_FALSE(is_whole(broken));
  }
  CHECK_FALSE(esi::is_whole_video(folder / "none"));
}

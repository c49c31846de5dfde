// A zip archive with one text recording in it.
#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_source.hpp"
#include "io/text/read_text.hpp"
#include "support/sample_text.hpp"
#include "support/scripted_reader.hpp"
#include "support/zip_file.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

struct Read {
  std::vector<Event> events;
  Losses losses;
  std::string error;
};

Read read_zip(const std::string& bytes) {
  const TempFolder folder;
  Read result;
  try {
    const auto source = open_recording(folder.write("events.zip", bytes), {});
    result.events = drain(*source).events;
    result.losses = source->losses();
  } catch (const Error& error) {
    result.error = error.what();
  }
  return result;
}

}  // namespace

TEST_CASE("the one text in a zip archive is read like the text itself") {
  const std::string text = "12 9\n" + sample_text(20000, 10);
  const bool is_deflated = GENERATE(true, false);
  std::vector<ZipEntry> entries = {{"folder/", "", false}, {"folder/events.txt", text, is_deflated}};
  if (is_deflated) entries.push_back({"__MACOSX/folder/._events.txt", "of no interest"});
  const TempFolder folder;
  const auto source = open_recording(folder.write("events.zip", zip_archive(entries)), {});
  CHECK(source->sensor_size() == SensorSize{12, 9});
  CHECK(drain(*source).events == read_text(text).events);
  CHECK_FALSE(source->losses().any());
}

TEST_CASE("an archive that is not one text recording is an error in words") {
  struct Row {
    std::string bytes, told;
  };
  const std::string text = sample_text(100, 1000);
  const std::string whole = zip_archive({{"events.txt", text}});
  const auto row = GENERATE_COPY(Row{zip_archive({}), "holds 0 files"},
                                 Row{zip_archive({{"a.txt", text}, {"b.txt", text}}), "holds 2 files"},
                                 Row{zip_archive({{"events.txt", text, true, true}}), "cannot be read"},
                                 Row{zip_archive({{"events.txt", ""}}), "empty"},
                                 Row{whole.substr(0, whole.size() - 30), "cannot be opened"},
                                 Row{zip_archive({{"events.txt", std::string(1000, '\0')}}), "binary"});
  const Read result = read_zip(row.bytes);
  CHECK_THAT(result.error, Contains("events.zip: ") && Contains(row.told));
}

TEST_CASE("damage within the archive's text is counted, and the lines before it are used") {
  const std::string text = sample_text(50000, 10);
  const auto expected = read_text(text).events;

  const Read checksum = read_zip(zip_archive({{"events.txt", text, true, false, 1}}));
  CHECK(checksum.error.empty());
  CHECK(checksum.losses.of(Damage::cut_packet) == 1);
  CHECK(checksum.events.size() + 1 >= expected.size());

  std::string bytes = zip_archive({{"events.txt", text}});
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 40; ++i) bytes[i] = '\xff';
  const Read broken = read_zip(bytes);  // what is decoded behind the damage is rarely text
  CHECK((broken.losses.any() || !broken.error.empty()));
  CHECK(broken.events.size() < expected.size());
}

#include "esi/sweep/sweep_store.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

SweepHeader header_of(const std::string& axis = "tau_s=1,2") {
  SweepHeader header;
  header.version = "test";
  header.config.add_axis(parse_axis(axis));
  header.recordings = {
      {"a.h5", "truth.json", 10, "12345678", "0", 4.0, {{"all", {0, 4'000'000}}}, {346, 260}, ""}};
  return header;
}

CellRecord record_of(std::size_t cell) { return {cell, 0, 0, {{1'000'000, 0, true}}, {PhaseRecord{}}}; }

std::filesystem::path filled(const TempFolder& folder) {
  SweepStore store(folder.path(), to_json(header_of()));
  store.add({record_of(0), record_of(1)});
  store.add({record_of(1)});  // once is enough
  return folder.path() / kStoreName;
}

void append(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::app) << text;
}

}  // namespace

TEST_CASE("A store that is opened again has what was added") {
  const TempFolder folder;
  filled(folder);
  const SweepStore store(folder.path(), to_json(header_of()));
  CHECK(store.records().size() == 2);
  CHECK(store.has(1, 0, 0));
  CHECK_FALSE(store.has(1, 0, 1));
}

TEST_CASE("A torn last line is ignored, at every length, and is gone when the next one is added") {
  const TempFolder folder;
  const auto file = filled(folder);
  const std::string whole = content_of(file), line = to_json(record_of(0)).dump();
  for (std::size_t length = 1; length < line.size(); length += 7) {
    std::ofstream(file) << whole << line.substr(0, length);
    SweepStore store(folder.path(), to_json(header_of()));
    CHECK(store.records().size() == 2);
    CHECK(content_of(file) == whole);
  }
}

TEST_CASE("A header that was torn is written anew") {
  const TempFolder folder;
  folder.write(kStoreName, R"({"store": "esi-sw)");
  SweepStore store(folder.path(), to_json(header_of()));
  store.add({record_of(0)});
  CHECK(read_store(folder.path()).records.size() == 1);
}

TEST_CASE("A damaged line that is not the last is an error with its number") {
  for (const char* const damage : {"{\"cell\": 0,", "", "nonsense", "{}", R"({"cell":9,"recording":0})",
                                   R"({"cell":0,"recording":5})"}) {
    const TempFolder folder;
    const auto file = filled(folder);
    append(file, std::string(damage) + "\n" + to_json(record_of(0)).dump() + "\n");
    CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(header_of())), Contains("cells.jsonl, line 4"));
  }
}

TEST_CASE("Any change of a line is noticed, be it a result that could be") {
  const TempFolder folder;
  const auto file = filled(folder);
  std::string text = content_of(file);
  const std::size_t at = text.find("\"detected\":\"8\"", text.find('\n'));
  REQUIRE(at != std::string::npos);
  text[at + 12] = '0';
  std::ofstream(file) << text;
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(header_of())),
                    Contains("line 2") && Contains("its sum is wrong"));
}

TEST_CASE("A folder of one shard takes no other") {
  const TempFolder folder;
  nlohmann::json first = to_json(header_of()), second = first;
  first["shard"] = "1/2";
  second["shard"] = "2/2";
  SweepStore(folder.path(), first);
  CHECK_THROWS_WITH(SweepStore(folder.path(), second), Contains("1/2") && Contains("2/2"));
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(header_of())), Contains("1/2"));
}

TEST_CASE("A store of another sweep is refused with what differs, a moved recording is not") {
  const TempFolder folder;
  filled(folder);
  SweepHeader moved = header_of();
  moved.recordings[0].path = "elsewhere/a.h5";
  CHECK(SweepStore(folder.path(), to_json(moved)).records().size() == 2);
  SweepHeader other = header_of();
  other.recordings[0].crc32 = "87654321";
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(other)), Contains("12345678") && Contains("87654321"));
  other = header_of();
  other.version = "newer";
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(other)), Contains("newer"));
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(header_of("tau_s=1,3"))), Contains("another sweep"));
  other = header_of();
  other.config.detector.quad_decimate = 2.0;
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(other)), Contains("quad_decimate"));
}

TEST_CASE("One run at a time holds a store") {
  const TempFolder folder;
  const SweepStore first(folder.path(), to_json(header_of()));
  CHECK_THROWS_WITH(SweepStore(folder.path(), to_json(header_of())), Contains("another run"));
}

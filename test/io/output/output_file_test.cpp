#include "esi/io/output/output_file.hpp"

#include <catch2/catch.hpp>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using Catch::Contains;
using esi::OutputFile;
using esi::test::content_of;
using esi::test::error_of;
using esi::test::names_in;
using esi::test::TempFolder;
using Names = std::vector<std::string>;

TEST_CASE("A file is beside its place until commit, then in its place") {
  const TempFolder folder;
  folder.write("a.txt", "old");
  {
    OutputFile file(folder / "a.txt");
    file.write("new");
    CHECK(names_in(folder.path()) == Names{"a.txt", "a.txt.part"});
    CHECK(content_of(folder / "a.txt") == "old");
    file.commit();
    CHECK(names_in(folder.path()) == Names{"a.txt"});
    CHECK(content_of(folder / "a.txt") == "new");
  }
  CHECK(content_of(folder / "a.txt") == "new");
}

TEST_CASE("A file that is not committed leaves nothing") {
  const TempFolder folder;
  { OutputFile(folder / "a.txt").write("half"); }
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("What is written in pieces arrives in order, whatever their sizes") {
  const TempFolder folder;
  std::string expected;
  OutputFile file(folder / "a.bin");
  // Around and beyond any buffer's size.
  for (const std::size_t size : {1u, 65535u, 1u, 65536u, 0u, 65537u, 200000u, 3u}) {
    const std::string piece(size, static_cast<char>('a' + expected.size() % 26));
    file.write(piece);
    expected += piece;
  }
  const std::vector<std::byte> bytes{std::byte{0}, std::byte{255}};
  file.write(bytes);
  expected += std::string("\0\xff", 2);
  file.commit();
  CHECK((content_of(folder / "a.bin") == expected));
}

TEST_CASE("A write that fails names the file and the reason, and leaves what was there") {
  const TempFolder folder;
  folder.write("a.txt", "old");
  // The limit is met in write() or, for what was still buffered, in commit().
  const std::size_t size = GENERATE(1001u, 70000u, 200000u);
  const esi::test::FileSizeLimit limit(1000);
  const auto error = error_of([&] { esi::write_file(folder / "a.txt", std::string(size, 'x')); });
  CHECK_THAT(error.what(), Contains((folder / "a.txt").string()) && Contains("File too large"));
  CHECK(error.kind() == esi::Error::Kind::failure);
  CHECK(names_in(folder.path()) == Names{"a.txt"});
  CHECK(content_of(folder / "a.txt") == "old");
}

TEST_CASE("A place that cannot take a file is refused with the reason") {
  const TempFolder folder;
  folder.write("file", "");
  std::filesystem::create_directory(folder / "folder");
  struct Row {
    std::filesystem::path path;
    std::string reason;
  };
  const std::vector<Row> rows = {
      {folder / "no" / "a.txt", "No such file"},
      {folder / "file" / "a.txt", "Not a directory"},
      {folder / "folder", "Is a directory"},
      {"/dev/null", "is a device"},
      {std::filesystem::path(esi::test::kReadOnlyFolder) / "a.txt", "cannot be created"}};
  for (const Row& row : rows) {
    CHECK_THAT(error_of([&] { OutputFile file(row.path); }).what(),
               Contains(row.path.string()) && Contains(row.reason));
  }
  CHECK(names_in(folder.path()) == Names{"file", "folder"});
}

TEST_CASE("A folder that vanishes before commit is an error") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "out");
  OutputFile file(folder / "out" / "a.txt");
  std::filesystem::remove_all(folder / "out");
  CHECK_THROWS_WITH(file.commit(), Contains("a.txt") && Contains("No such file"));
}

TEST_CASE("A text file is read whole, or refused when it is larger than it may be") {
  const TempFolder folder;
  const std::string text(100000, 'x');
  const auto path = folder.write("a.txt", text);
  CHECK((esi::read_text_file(path, 100000) == text));
  CHECK_THROWS_WITH(esi::read_text_file(path, 99999), Contains("a.txt") && Contains("99999 bytes"));
  CHECK_THROWS_WITH(esi::read_text_file("/dev/zero", 1000), Contains("/dev/zero"));
  CHECK_THROWS_WITH(esi::read_text_file(folder / "none"), Contains("none") && Contains("No such file"));
  CHECK_THROWS_WITH(esi::read_text_file(folder.path()), Contains("Is a directory"));
}

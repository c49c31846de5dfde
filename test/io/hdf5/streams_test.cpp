// HDF5 and the standard streams.
#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

/// Puts a file in the place of a file descriptor of this process.
class Redirection {
 public:
  Redirection(int descriptor, const std::filesystem::path& path)
      : descriptor_(descriptor), saved_(dup(descriptor)) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT, 0600);
    dup2(file, descriptor);
    close(file);
  }
  ~Redirection() {
    dup2(saved_, descriptor_);
    close(saved_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  int descriptor_, saved_;
};

TEST_CASE("HDF5 does not print its errors, and prints those of others as before") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", Columns(3000), {.chunk = 1000, .filters = gzip});
    file.replace_chunk("/t", 1000, "this is not gzip", 16);
  }
  {
    const Redirection redirection(STDERR_FILENO, folder / "quiet");
    CHECK(read_hdf5(folder / "a.h5").events.size() == 2000);
    CHECK_FALSE(hdf5_error(folder.write("no.h5", "hello")).empty());
  }
  CHECK(content_of(folder / "quiet").empty());
  {
    const Redirection redirection(STDERR_FILENO, folder / "loud");
    CHECK(H5Fopen((folder / "no.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT) < 0);
  }
  CHECK_THAT(content_of(folder / "loud"), Contains("HDF5-DIAG"));
}

TEST_CASE("HDF5 on standard input is refused with a sentence") {
  const TempFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    write_columns(file, "/", Columns(3));
  }
  const Redirection redirection(STDIN_FILENO, folder / "a.h5");
  CHECK_THAT(hdf5_error("-"), Contains("standard input") && Contains("give the file's path"));
}

}  // namespace

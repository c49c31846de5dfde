#include "esi/io/output/y4m_sink.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "esi/io/output/file_descriptor.hpp"
#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using Catch::Contains;
using esi::FileDescriptor;
using esi::Y4mSink;
using esi::test::error_of;
using esi::test::frame_of;

namespace {

/// What a sink writes into a file.
std::string written_by(const esi::SinkContext& context, const std::vector<cv::Mat1b>& frames) {
  const esi::test::TempFolder folder;
  const FileDescriptor file(::open((folder / "out").c_str(), O_WRONLY | O_CREAT, 0600));
  Y4mSink sink(context, file.get());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sink.write(frame_of(static_cast<std::int64_t>(i), frames[i]));
  }
  sink.finish("{}");
  return esi::test::content_of(folder / "out");
}

}  // namespace

TEST_CASE("A Y4M stream is a header and the frames' pixels, row by row") {
  const cv::Mat1b first = (cv::Mat1b(2, 3) << 'a', 'b', 'c', 'd', 'e', 'f');
  const cv::Mat1b wide = (cv::Mat1b(2, 4) << 'x', 'g', 'h', 'i', 'x', 'j', 'k', 'l');
  const cv::Mat1b part = wide(cv::Rect(1, 0, 3, 2));  // its rows are not adjacent in memory
  const std::string header = "YUV4MPEG2 W3 H2 F100:1 Ip A1:1 Cmono\n";
  CHECK(written_by({{3, 2}, 100, ""}, {first, part}) == header + "FRAME\nabcdefFRAME\nghijkl");
  CHECK(written_by({{3, 2}, 100, ""}, {}) == header);
}

TEST_CASE("A frame rate is a reduced fraction, exact to the micro-hertz") {
  struct Row {
    double fps;
    std::string text;
  };
  for (const Row& row :
       std::vector<Row>{{30, "F30:1 "}, {12.5, "F25:2 "}, {29.97, "F2997:100 "}, {1e-6, "F1:1000000 "}}) {
    CHECK_THAT(written_by({{1, 1}, row.fps, ""}, {}), Contains(row.text));
  }
  for (const double fps : {0.0, -1.0, 1e-9, std::nan(""), HUGE_VAL}) {
    CHECK(error_of([&] { Y4mSink({{1, 1}, fps, ""}, STDOUT_FILENO); }).kind() == esi::Error::Kind::usage);
  }
}

TEST_CASE("A reader that goes away is told apart from a fault") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  FileDescriptor out(ends[0]);
  const FileDescriptor in(ends[1]);
  auto* const old = std::signal(SIGPIPE, SIG_IGN);
  Y4mSink sink({{3, 2}, 100, ""}, in.get());
  sink.write(frame_of(0, cv::Mat1b(2, 3)));
  out.close();
  CHECK_THROWS_AS(sink.write(frame_of(1, cv::Mat1b(2, 3))), esi::ClosedPipe);
  std::signal(SIGPIPE, old);
}

TEST_CASE("A slow reader of a non-blocking pipe gets everything") {
  int ends[2];
  REQUIRE(::pipe2(ends, O_NONBLOCK) == 0);
  const FileDescriptor out(ends[0]);
  FileDescriptor in(ends[1]);
  const cv::Mat1b grey = esi::test::noise(0, 640, 480);  // larger than a pipe's buffer
  std::string received;
  std::thread reader([&] {
    std::vector<char> chunk(5000);
    for (ssize_t size = -1; size != 0;) {
      size = ::read(out.get(), chunk.data(), chunk.size());
      if (size > 0) received.append(chunk.data(), static_cast<std::size_t>(size));
    }
  });
  Y4mSink sink({{640, 480}, 100, ""}, in.get());
  sink.write(frame_of(0, grey));
  in.close();
  reader.join();
  CHECK((received.substr(received.size() - grey.total()) == std::string(grey.begin(), grey.end())));
}

TEST_CASE("A full device is a failure with its reason") {
  const FileDescriptor full(::open("/dev/full", O_WRONLY));
  Y4mSink sink({{3, 2}, 100, ""}, full.get());
  const auto error = error_of([&] { sink.write(frame_of(0, cv::Mat1b(2, 3))); });
  CHECK_THAT(error.what(), Contains("standard output") && Contains("No space left"));
  CHECK(error.kind() == esi::Error::Kind::failure);
}

TEST_CASE("A terminal gets no frames") {
  const FileDescriptor main_side(::posix_openpt(O_RDWR | O_NOCTTY));
  REQUIRE(::grantpt(main_side.get()) == 0);
  REQUIRE(::unlockpt(main_side.get()) == 0);
  const FileDescriptor terminal(::open(::ptsname(main_side.get()), O_RDWR | O_NOCTTY));
  REQUIRE(terminal.is_open());
  const auto error = error_of([&] { Y4mSink({{3, 2}, 100, ""}, terminal.get()); });
  CHECK_THAT(error.what(), Contains("terminal"));
  CHECK(error.kind() == esi::Error::Kind::usage);
}

TEST_CASE("A frame of another size or out of turn is refused") {
  const FileDescriptor file(::open("/dev/null", O_WRONLY));
  Y4mSink sink({{3, 2}, 100, ""}, file.get());
  CHECK_THROWS_WITH(sink.write(frame_of(0, cv::Mat1b(3, 2))), Contains("2x3") && Contains("3x2"));
  CHECK_THROWS_WITH(sink.write(frame_of(1, cv::Mat1b(2, 3))), Contains("frame 1") && Contains("frame 0"));
}

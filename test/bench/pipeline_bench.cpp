// How fast recordings are read, frames written, and the whole run is, each beside a floor measured in the
// same run, round by round. Ratios carry over to other machines and hours; absolute figures don't.
//   build/release/bin/bench_pipeline

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/timing.hpp"
#include "esi/io/byte_source.hpp"
#include "esi/io/event_source.hpp"
#include "esi/io/output/encode_png.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/recon_job.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace {

namespace fs = std::filesystem;
using esi::bench::median;
constexpr int kRounds = 7;

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Comparison {
  double ours_s;
  double floor_s;
};

/// Medians of runs in turn, so that both see the same hour of the machine.
Comparison compare(const std::function<void()>& ours, const std::function<void()>& floor) {
  std::vector<double> ours_s, floor_s;
  for (int round = 0; round < kRounds; ++round) {
    ours_s.push_back(seconds_of(ours));
    floor_s.push_back(seconds_of(floor));
  }
  return {median(ours_s), median(floor_s)};
}

esi::ReadOptions tag_board_options() {
  esi::ReadOptions options;
  options.size = "346x260";
  options.time_zero = esi::TimeZero::first_event;
  return options;
}

std::size_t count_events(const fs::path& path) {
  const auto source = esi::open_recording(path, tag_board_options());
  esi::Packet packet;
  std::size_t events = 0;
  while (source->next(packet)) events += packet.events.size();
  return events;
}

/// Every byte of the file through one buffer, as `cat` would.
void read_bytes(const fs::path& path) {
  esi::ByteSource bytes(path);
  std::vector<std::byte> buffer(std::size_t{1} << 18);
  while (bytes.read(buffer) > 0) {
  }
}

void bench_readers() {
  fmt::print("{:<28} {:>8} {:>14} {:>18}\n", "reader", "Mev/s", "floor, Mev/s", "floor's time/ours");
  for (const char* name : {"tagboard/tagboard.rpg.txt", "tagboard/tagboard.txyp_us.csv",
                           "tagboard/tagboard.dsec_gzip.h5", "tagboard/tagboard.dsec_blosc.h5",
                           "tagboard/tagboard.e2calib_eds_lzf.h5", "aedat4/cuke-emlb_demo-01.aedat4"}) {
    const auto path = esi::test::shared_data(name);
    if (!path) return;
    const auto million_events = static_cast<double>(count_events(*path)) * 1e-6;
    const auto [ours_s, floor_s] = compare([&] { count_events(*path); }, [&] { read_bytes(*path); });
    fmt::print("{:<28} {:>8.1f} {:>14.1f} {:>18.2f}\n", path->filename().string(), million_events / ours_s,
               million_events / floor_s, floor_s / ours_s);
  }
}

std::vector<cv::Mat1b> frames_of(esi::EventSource& source) {
  const auto method = esi::method_named("esi").configure()->create(*source.sensor_size());
  esi::FixedRate schedule(100, 0);
  std::vector<cv::Mat1b> frames;
  esi::Packet packet;
  while (source.next(packet)) {
    std::span<const esi::Event> events = packet.events;
    while (const auto cut = schedule.next(events)) {
      method->process(events.first(cut->events));
      method->render(cut->t_us, frames.emplace_back());
      events = events.subspan(cut->events);
    }
    method->process(events);
  }
  return frames;
}

void bench_png(const fs::path& recording) {
  const auto frames = frames_of(*esi::open_recording(recording, tag_board_options()));
  const esi::test::TempFolder folder;
  const auto [ours_s, floor_s] = compare(
      [&] {
        for (const auto& grey : frames) {
          const auto png = esi::encode_png(grey, 1);
          esi::write_file(folder / "frame.png", std::as_bytes(std::span(png)));
        }
      },
      [&] {
        for (const auto& grey : frames) {
          esi::write_file(folder / "frame.raw", std::as_bytes(std::span(grey.data, grey.total())));
        }
      });
  const auto count = static_cast<double>(frames.size());
  fmt::print("\nPNG, 346x260: {:.0f} us a frame; floor, the bytes written as they are: {:.0f} us\n",
             ours_s / count * 1e6, floor_s / count * 1e6);
}

void bench_whole_run(const fs::path& recording) {
  const esi::test::TempFolder folder;
  esi::ReconConfig config;
  config.read = tag_board_options();
  config.sink.force = true;
  fmt::print("\nwhole run, {}, 1 s of recording to 100 PNG files; floor: the recording read\n",
             recording.filename().string());
  for (const int threads : {1, 2}) {
    const esi::ReconJob job{recording, folder / "out", threads, "bench"};
    const auto [ours_s, floor_s] =
        compare([&] { esi::run_job(job, config); }, [&] { count_events(recording); });
    fmt::print("{} thread{}: {:.0f} ms, {:.1f} x real time; floor {:.0f} ms\n", threads,
               threads == 1 ? "" : "s", ours_s * 1e3, 1.0 / ours_s, floor_s * 1e3);
  }
}

}  // namespace

int main() {
  bench_readers();
  for (const char* name : {"tagboard/tagboard.rpg.txt", "tagboard/tagboard.dsec_blosc.h5"}) {
    const auto recording = esi::test::shared_data(name);
    if (!recording) return 0;
    if (std::string(name).ends_with(".txt")) bench_png(*recording);
    bench_whole_run(*recording);
  }
}

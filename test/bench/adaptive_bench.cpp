// What the blocks of esi-adaptive cost beside plain ESI, and beside the same steps put around ESI, measured
// in the same run, round by round. Ratios carry over to other machines and hours; absolute figures don't.
//   build/release/bin/bench_adaptive

#include <fmt/format.h>

#include <string>
#include <vector>

#include "esi/recon/methods.hpp"
#include "esi/recon/steps/stepped_reconstructor.hpp"
#include "recon_streams.hpp"

namespace {

constexpr int kRounds = 31;

struct Row {
  std::string name;
  std::string method;
  std::vector<std::string> settings;
  esi::StepOptions steps;
};

esi::StepOptions steps(bool balance, std::int64_t background_us, bool median, double blur_px) {
  esi::StepOptions options;
  options.balance.balance = balance;
  options.filters.background_us = background_us;
  options.smoothing = {median, blur_px};
  return options;
}

/// The first one is what the others are compared with.
std::vector<Row> rows() {
  const std::vector<std::string> plain{"balance=false", "blur_px=0"};
  const auto plain_but = [&](const std::string& setting) {
    auto settings = plain;
    settings.push_back(setting);
    return settings;
  };
  return {{"esi", "esi", {}, {}},
          {"esi-adaptive", "esi-adaptive", {}, {}},
          {"  all blocks off", "esi-adaptive", plain, {}},
          {"  only balance", "esi-adaptive", plain_but("balance=true"), {}},
          {"  only background 10 ms", "esi-adaptive", plain_but("background_us=10000"), {}},
          {"  only median", "esi-adaptive", plain_but("median=true"), {}},
          {"  only blur 0.7 px", "esi-adaptive", plain_but("blur_px=0.7"), {}},
          {"esi + step balance", "esi", {}, steps(true, 0, false, 0.0)},
          {"esi + step background 10 ms", "esi", {}, steps(false, 10000, false, 0.0)},
          {"esi + step median", "esi", {}, steps(false, 0, true, 0.0)},
          {"esi + step blur 0.7 px", "esi", {}, steps(false, 0, false, 0.7)}};
}

std::unique_ptr<esi::Reconstructor> make(const Row& row, esi::SensorSize size, esi::RemovedEvents& removed) {
  const auto config = esi::method_named(row.method).configure();
  for (const std::string& setting : row.settings) config->options().set_assignment(setting);
  return esi::with_steps(config->create(size), row.steps, {size, {}, {}, {}}, removed);
}

void compare(const esi::bench::Stream& stream) {
  const std::vector<Row> all = rows();
  std::vector<std::vector<double>> events_s(all.size()), frame_s(all.size()), ratios(all.size());
  cv::Mat1b grey;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t r = 0; r < all.size(); ++r) {
      esi::RemovedEvents removed;
      const auto method = make(all[r], stream.size, removed);
      events_s[r].push_back(esi::bench::seconds_for(stream, *method));
      const std::int64_t t_us = stream.events.back().t_us + 1;
      frame_s[r].push_back(esi::bench::seconds([&] { method->render(t_us, grey); }));
      ratios[r].push_back(events_s[r].back() / events_s.front().back());
    }
  }
  fmt::print("{} {}, {} events\n{:<30} {:>9} {:>10} {:>10}\n", stream.name, to_string(stream.size),
             stream.events.size(), "", "ns/event", "times esi", "ms/frame");
  for (std::size_t r = 0; r < all.size(); ++r) {
    fmt::print("{:<30} {:>9.2f} {:>10.2f} {:>10.3f}\n", all[r].name,
               1e9 * esi::bench::median(events_s[r]) / static_cast<double>(stream.events.size()),
               esi::bench::median(ratios[r]), 1e3 * esi::bench::median(frame_s[r]));
  }
}

}  // namespace

int main() {
  for (const esi::bench::Stream& stream : esi::bench::streams()) compare(stream);
}

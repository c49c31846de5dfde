#include <fmt/format.h>

#include <optional>

#include "esi/io/output/numbered_pictures.hpp"
#include "esi/pipeline/simulation/regular_times.hpp"
#include "esi/pipeline/simulation/sim_output.hpp"

namespace esi {
namespace {

class FramesOutput final : public SimOutput {
 public:
  FramesOutput(const std::filesystem::path& folder, bool with_pictures) : list_(folder / "exposures.csv") {
    list_.write("index,begin_s,end_s\n");
    if (with_pictures) pictures_.emplace(folder / "frames");
  }

  void take(const Simulator& /*simulator*/, const Packet& packet) override {
    for (const IntensityFrame& frame : packet.frames) {
      const Interval& exposure = frame.exposure;
      list_.write(fmt::format("{},{},{}\n", index_++, seconds_text(exposure.begin_us),
                              seconds_text(exposure.end_us)));
      if (pictures_) pictures_->add(frame.image, exposure.begin_us + exposure.duration_us() / 2);
    }
  }

  void finish() override {
    if (pictures_) pictures_->commit();
    list_.commit();
  }

 private:
  OutputFile list_;
  std::optional<NumberedPictures> pictures_;
  std::int64_t index_ = 0;
};

class CleanOutput final : public SimOutput {
 public:
  CleanOutput(const std::filesystem::path& folder, double fps) : times_(fps), pictures_(folder / "clean") {}

  void take(const Simulator& simulator, const Packet& /*packet*/) override {
    while (const auto t_us = times_.next(simulator.t_us())) {
      pictures_.add(simulator.scenario().clean_frame(*t_us), *t_us);
    }
  }
  void finish() override { pictures_.commit(); }

 private:
  RegularTimes times_;
  NumberedPictures pictures_;
};

}  // namespace

std::unique_ptr<SimOutput> open_frames_output(const std::filesystem::path& folder, bool with_pictures) {
  return std::make_unique<FramesOutput>(folder, with_pictures);
}

std::unique_ptr<SimOutput> open_clean_output(const std::filesystem::path& folder, double fps) {
  return std::make_unique<CleanOutput>(folder, fps);
}

}  // namespace esi

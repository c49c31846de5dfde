#include "fuzz/seeds.hpp"

#include "support/recordings.hpp"

namespace esi::fuzz {
namespace {

constexpr const char* kConfig = R"({"method": "esi", "set": {"tau_s": 2.0, "decay": "power"}, "fps": 50,
  "size": "240x180", "roi": "10,10,20x20", "start": 0.5, "strict": true})";

constexpr const char* kGroundTruth = R"({"phases": [{"name": "a", "start_s": 0, "end_s": 1.5},
  {"name": "b", "start_s": 2, "end_s": 3}], "tags": {"family": "tag36h11", "ids": [0, 1], "size_m": {"0": 0.3}},
  "camera": {"width": 4, "height": 3, "fx": 2, "fy": 2, "cx": 1, "cy": 1, "distortion": [0.1]},
  "corners": "corners.csv", "target_poses": "t.tum", "camera_poses": "c.tum", "clean_frames": "c/images.txt"})";

}  // namespace

std::vector<Seed> seeds() {
  std::vector<Seed> all = {{"config", "config.json", kConfig}, {"ground-truth", "truth.json", kGroundTruth}};
  const auto events = test::moving_edge(300);
  for (const test::Encoder& encoder : test::encoders()) {
    all.push_back({std::string(encoder.format), std::string(encoder.layout), encoder.encode(events)});
  }
  return all;
}

}  // namespace esi::fuzz

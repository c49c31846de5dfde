// Every HDF5 layout, cut and damaged at random.
#include <catch2/catch.hpp>
#include <random>

#include "support/hdf5_recordings.hpp"
#include "support/random_events.hpp"
#include "support/read_hdf5.hpp"
#include "support/temp_folder.hpp"

/// libhdf5 loses memory where it gives up on a damaged file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace {

using namespace esi;
using namespace esi::test;
using Catch::Contains;

using Encode = std::string (*)(std::span<const Event>);
constexpr Encode kEncoders[] = {hdf5_recording, mvsec_recording, monash_recording, metavision_hdf5_recording};

TEST_CASE("HDF5 recordings of every layout that are cut are an error, nearly anywhere") {
  const TempFolder folder;
  const std::vector<Event> events = random_events({0, 0, 240, 180}, 20, 5, 1);
  for (const Encode encode : kEncoders) {
    const std::string whole = encode(events);
    for (std::size_t size = 1; size < whole.size(); size += 397) {
      INFO(size);
      CHECK_THAT(hdf5_error(folder.write("cut.h5", whole.substr(0, size))), Contains("cut.h5: "));
    }
  }
}

TEST_CASE("Random damage to HDF5 recordings of every layout never ends the program") {
  const TempFolder folder;
  constexpr int kDamages = 150;
  std::mt19937 random(1);
  const std::vector<Event> events = random_events({0, 0, 240, 180}, 20, 5, 1);
  ReadOptions options;
  options.size = "240x180";
  for (const Encode encode : kEncoders) {
    const std::string whole = encode(events);
    int read = 0;
    for (int i = 0; i < kDamages; ++i) {
      std::string damaged = whole;
      for (int k = 0; k < 3; ++k) damaged[random() % whole.size()] = static_cast<char>(random());
      folder.write("a.h5", damaged);
      try {
        const Reading reading = read_hdf5(folder / "a.h5", options);
        CHECK(reading.largest_packet <= kPacketEvents);
        ++read;
      } catch (const Error& error) {
        CHECK_THAT(error.what(), Contains("a.h5"));
      }
    }
    CHECK(read > 0);
    CHECK(read < kDamages);
  }
}

}  // namespace

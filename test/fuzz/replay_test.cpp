// What fuzzing found, and what it starts from, once more: in every build, with every sanitizer.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
namespace fs = std::filesystem;

namespace {

std::int64_t replay(const std::string& target, const std::string& bytes) {
  return fuzz::run(target, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

/// Runs every file of test/fuzz/FOLDER/<target>/; returns how many there are.
int replay_folder(const std::string& folder) {
  int files = 0;
  for (const std::string& target : fuzz::targets()) {
    const fs::path path = source_dir() / "test" / "fuzz" / folder / target;
    if (!fs::exists(path)) continue;
    for (const auto& entry : fs::directory_iterator(path)) {
      CAPTURE(entry.path());
      replay(target, content_of(entry.path()));
      ++files;
    }
  }
  return files;
}

}  // namespace

TEST_CASE("every target has a seed, and seeds are read to the end without a broken promise") {
  const auto seeds = fuzz::seeds();
  for (const std::string& target : fuzz::targets()) {
    CAPTURE(target);
    CHECK(std::any_of(seeds.begin(), seeds.end(),
                      [&](const fuzz::Seed& seed) { return seed.target == target; }));
  }
  for (const fuzz::Seed& seed : seeds) {
    CAPTURE(seed.target, seed.name);
    CHECK(replay(seed.target, seed.bytes) > 0);
  }
}

TEST_CASE("the corpus that fuzzing grew is taken without a broken promise") {
  CHECK(replay_folder("corpus") > 0);
}

TEST_CASE("every input that ever broke a promise is taken now") { CHECK(replay_folder("crashes") > 0); }

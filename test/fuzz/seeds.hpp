#pragma once

#include <string>
#include <vector>

namespace esi::fuzz {

/// A small, whole input that fuzzing starts from.
struct Seed {
  std::string target;
  std::string name;
  std::string bytes;
};

/// At least one for every target.
std::vector<Seed> seeds();

}  // namespace esi::fuzz

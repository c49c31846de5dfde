// make_seeds FOLDER: writes what fuzzing starts from, a folder a target; without FOLDER, lists the targets.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc != 2) {
    for (const std::string& target : esi::fuzz::targets()) std::cout << target << "\n";
    return 0;
  }
  for (const auto& [target, name, bytes] : esi::fuzz::seeds()) {
    const fs::path folder = fs::path(argv[1]) / target;
    fs::create_directories(folder);
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  return 0;
}

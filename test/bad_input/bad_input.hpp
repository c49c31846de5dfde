#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "support/temp_folder.hpp"

namespace esi::test {

/// A recording or config that is not as it should be, and what a person gets for it.
struct BadInput {
  std::string what;  ///< as in the table of docs/bad_input.md
  int exit_code = 1;
  std::string told;                    ///< a part of the message; empty: no message at all
  std::function<std::string()> bytes;  ///< of the file
  std::vector<std::string> arguments = {"--size", "240x180"};
};

/// Cases of one kind of input.
struct BadInputs {
  std::string title;
  std::string file_name;  ///< config.json and ground_truth.json are given with a good recording
  std::vector<BadInput> cases;
};

BadInputs bad_text();
BadInputs bad_hdf5();
BadInputs bad_aedat2();
BadInputs bad_aedat3();
BadInputs bad_aedat4();
BadInputs bad_prophesee();
BadInputs bad_rosbags();
BadInputs bad_configs();
BadInputs bad_truths();

}  // namespace esi::test

#pragma once

#include <string>
#include <vector>

#include "esi/recon/onnx_header.hpp"

namespace esi {

/// What a recurrent network wants and gives, out of its file's header:
///   inputs   voxel   1 x bins x height x width,   NAME_in   1 x channels x height/scale x width/scale
///   outputs  image   1 x 1 x height x width,      NAME_out  as NAME_in, which it becomes in the next run
struct NetworkForm {
  /// A recurrent state.
  struct State {
    std::string input;
    std::string output;
    int channels = 0;
    int scale = 1;  ///< how many pixels a side one of its values stands for
  };

  int bins = 0;
  int height_px = 0;  ///< the one height that the model takes, or 0: any
  int width_px = 0;
  std::vector<State> states;

  /// Throws an Error, without the file's name, where the header has another form.
  static NetworkForm of(const OnnxHeader& header);

  /// The least common multiple of the states' scales divides every size that the network can take.
  int size_multiple_px() const;
};

}  // namespace esi

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace esi {

/// One input or output that an ONNX file declares.
struct OnnxValue {
  std::string name;
  std::vector<std::string> shape;  ///< per axis its length, or the symbol that stands for it, or ""
};

struct OnnxHeader {
  std::vector<OnnxValue> inputs;  ///< without the weights, which old files list here too
  std::vector<OnnxValue> outputs;
};

/// Reads what OpenCV's importer keeps to itself: the names and shapes of inputs and outputs, out of the
/// file's protocol buffer (onnx/onnx.proto). Throws an Error, without the file's name, where the bytes are no
/// ONNX file or end too early, and where a node needs what no input, weight or earlier node gives.
OnnxHeader read_onnx_header(std::string_view bytes);

}  // namespace esi

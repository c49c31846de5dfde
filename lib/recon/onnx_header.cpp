#include "esi/recon/onnx_header.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <set>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Numbers of the fields in onnx.proto.
enum Field : std::uint64_t {
  kModelGraph = 7,
  kGraphNode = 1,
  kGraphInitializer = 5,
  kGraphInput = 11,
  kGraphOutput = 12,
  kNodeInput = 1,
  kNodeOutput = 2,
  kTensorName = 8,
  kValueName = 1,
  kValueType = 2,
  kTypeTensor = 1,
  kTensorTypeShape = 2,
  kShapeDimension = 1,
  kDimensionValue = 1,
  kDimensionSymbol = 2,
};

[[noreturn]] void refuse() { throw Error("this is no ONNX model, or its end is missing"); }

std::uint64_t take_varint(std::string_view& bytes) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    if (bytes.empty()) refuse();
    const auto byte = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    value |= std::uint64_t{byte & 0x7FU} << shift;
    if (byte < 0x80U) return value;
  }
  refuse();
}

std::string_view take_bytes(std::string_view& bytes, std::uint64_t count) {
  if (count > bytes.size()) refuse();
  const std::string_view taken = bytes.substr(0, static_cast<std::size_t>(count));
  bytes.remove_prefix(static_cast<std::size_t>(count));
  return taken;
}

/// Calls visit(field, number, content) for each field of a message; `content` is empty but for wire type 2.
using Visit = std::function<void(std::uint64_t, std::uint64_t, std::string_view)>;
void for_each_field(std::string_view message, const Visit& visit) {
  while (!message.empty()) {
    const std::uint64_t key = take_varint(message);
    const std::uint64_t field = key >> 3U;
    if (field == 0) refuse();
    switch (key & 7U) {
      case 0:
        visit(field, take_varint(message), {});
        break;
      case 1:
        take_bytes(message, 8);
        break;
      case 2:
        visit(field, 0, take_bytes(message, take_varint(message)));
        break;
      case 5:
        take_bytes(message, 4);
        break;
      default:
        refuse();
    }
  }
}

std::string dimension_of(std::string_view message) {
  std::string text;
  for_each_field(message, [&](std::uint64_t field, std::uint64_t number, std::string_view content) {
    if (field == kDimensionValue) text = std::to_string(number);
    if (field == kDimensionSymbol) text = content;
  });
  return text;
}

/// TypeProto -> its tensor type -> its shape -> the axes.
std::vector<std::string> shape_of(std::string_view type) {
  std::vector<std::string> shape;
  for_each_field(type, [&](std::uint64_t field, std::uint64_t, std::string_view tensor) {
    if (field != kTypeTensor) return;
    for_each_field(tensor, [&](std::uint64_t part, std::uint64_t, std::string_view axes) {
      if (part != kTensorTypeShape) return;
      for_each_field(axes, [&](std::uint64_t kind, std::uint64_t, std::string_view dimension) {
        if (kind == kShapeDimension) shape.push_back(dimension_of(dimension));
      });
    });
  });
  return shape;
}

OnnxValue value_of(std::string_view message) {
  OnnxValue value;
  for_each_field(message, [&](std::uint64_t field, std::uint64_t, std::string_view content) {
    if (field == kValueName) value.name = content;
    if (field == kValueType) value.shape = shape_of(content);
  });
  return value;
}

std::string name_of_tensor(std::string_view message) {
  std::string name;
  for_each_field(message, [&](std::uint64_t field, std::uint64_t, std::string_view content) {
    if (field == kTensorName) name = content;
  });
  return name;
}

/// What is read and given along a graph, in its order.
class Names {
 public:
  void add(const std::string& name) { given_.insert(name); }

  /// OpenCV 4.6 crashes on a name that nothing gives.
  void need(std::string_view name) const {
    if (name.empty() || given_.count(std::string(name)) == 1)
      return;  // empty: an optional input that is left out
    throw Error(fmt::format("its graph needs '{}', which nothing in it gives", name));
  }

  void pass(std::string_view node) {
    for_each_field(node, [&](std::uint64_t field, std::uint64_t, std::string_view content) {
      if (field == kNodeInput) need(content);
    });
    for_each_field(node, [&](std::uint64_t field, std::uint64_t, std::string_view content) {
      if (field == kNodeOutput) add(std::string(content));
    });
  }

 private:
  std::set<std::string> given_;
};

/// The parts of a graph, in their order.
struct Graph {
  std::vector<std::string_view> nodes;
  std::set<std::string> weights;
  OnnxHeader header;

  explicit Graph(std::string_view message) {
    for_each_field(message, [&](std::uint64_t field, std::uint64_t, std::string_view content) {
      if (field == kGraphNode) nodes.push_back(content);
      if (field == kGraphInitializer) weights.insert(name_of_tensor(content));
      if (field == kGraphInput) header.inputs.push_back(value_of(content));
      if (field == kGraphOutput) header.outputs.push_back(value_of(content));
    });
    std::erase_if(header.inputs, [&](const OnnxValue& input) { return weights.count(input.name) == 1; });
  }

  void check_names() const {
    Names names;
    for (const std::string& name : weights) names.add(name);
    for (const OnnxValue& input : header.inputs) names.add(input.name);
    for (const std::string_view node : nodes) names.pass(node);
    for (const OnnxValue& output : header.outputs) names.need(output.name);
  }
};

}  // namespace

OnnxHeader read_onnx_header(std::string_view bytes) {
  std::optional<Graph> graph;
  for_each_field(bytes, [&](std::uint64_t field, std::uint64_t, std::string_view content) {
    if (field == kModelGraph) graph.emplace(content);
  });
  if (!graph) refuse();
  graph->check_names();
  return graph->header;
}

}  // namespace esi

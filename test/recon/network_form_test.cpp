#include "esi/recon/network_form.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "esi/core/error.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

std::string tiny_network() {
  return test::content_of(test::source_dir() / "test" / "models" / "tiny_network.onnx");
}

using Shape = std::vector<std::string>;

/// A network with one state of half the size.
OnnxHeader header() {
  return {{{"voxel", {"1", "5", "height", "width"}}, {"h1_in", {"1", "8", "height/2", "width/2"}}},
          {{"h1_out", {"1", "8", "height/2", "width/2"}}, {"image", {"1", "1", "height", "width"}}}};
}

template <class Change>
OnnxHeader changed(Change change) {
  OnnxHeader changed = header();
  change(changed);
  return changed;
}

}  // namespace

TEST_CASE("an ONNX file's header gives its inputs and outputs with their shapes") {
  const OnnxHeader header = read_onnx_header(tiny_network());
  REQUIRE(header.inputs.size() == 3);
  CHECK(header.inputs[0].name == "voxel");
  CHECK(header.inputs[0].shape == Shape{"1", "5", "height", "width"});
  CHECK(header.inputs[2].name == "h2_in");
  CHECK(header.inputs[2].shape == Shape{"1", "2", "height", "width"});
  REQUIRE(header.outputs.size() == 3);
  CHECK(header.outputs[2].name == "image");
}

TEST_CASE("bytes that are no ONNX file, or end too early, are refused") {
  const std::string whole = tiny_network();
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    CHECK_THROWS_WITH(read_onnx_header(whole.substr(0, length)), Contains("no ONNX model"));
  }
  CHECK_THROWS_WITH(read_onnx_header("hello, this is a text and no model"), Contains("no ONNX model"));
  CHECK_THROWS_AS(read_onnx_header(std::string(100, '\xFF')), Error);
  CHECK_THROWS_AS(read_onnx_header(std::string(100, '\0')), Error);
}

TEST_CASE("a graph that needs what nothing gives is refused before OpenCV crashes on it") {
  std::string dangling = tiny_network();
  const std::size_t used = dangling.find("\x0A\x0Asigmoid_24");  // a node's input
  REQUIRE(used != std::string::npos);
  dangling[used + 3] = 'x';
  CHECK_THROWS_WITH(read_onnx_header(dangling), Contains("needs 'sxgmoid_24', which nothing in it gives"));
  std::string no_image = tiny_network();
  const std::size_t given = no_image.find("\x12\x05image");  // a node's output
  REQUIRE(given != std::string::npos);
  no_image[given + 2] = 'x';
  CHECK_THROWS_WITH(read_onnx_header(no_image), Contains("needs 'image'"));
}

TEST_CASE("weights that are listed among the inputs are none") {
  // graph (7) of: initializer (5) with name (8) "w"; input (11) with name (1) "w"; input with name "x".
  const std::string graph = std::string("\x2A\x03\x42\x01w", 5) + "\x5A\x03\x0A\x01w" + "\x5A\x03\x0A\x01x";
  const OnnxHeader header =
      read_onnx_header("\x3A" + std::string(1, static_cast<char>(graph.size())) + graph);
  REQUIRE(header.inputs.size() == 1);
  CHECK(header.inputs[0].name == "x");
}

TEST_CASE("the form of a network: bins, states and their scales") {
  const NetworkForm form = NetworkForm::of(header());
  CHECK(form.bins == 5);
  CHECK(form.height_px == 0);
  CHECK(form.size_multiple_px() == 2);
  REQUIRE(form.states.size() == 1);
  CHECK(form.states[0].input == "h1_in");
  CHECK(form.states[0].output == "h1_out");
  CHECK(form.states[0].channels == 8);
  CHECK(form.states[0].scale == 2);
}

TEST_CASE("a network of one size says so, and its states' scales are ratios") {
  const NetworkForm form = NetworkForm::of(changed([](OnnxHeader& h) {
    h.inputs[0].shape = {"1", "3", "272", "352"};
    h.inputs[1].shape = h.outputs[0].shape = {"1", "8", "34", "44"};
  }));
  CHECK(form.bins == 3);
  CHECK(form.height_px == 272);
  CHECK(form.width_px == 352);
  CHECK(form.states[0].scale == 8);
}

TEST_CASE("a network of another form is refused with what it has") {
  const auto refusal = [](const OnnxHeader& header) {
    try {
      NetworkForm::of(header);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.inputs[0].name = "input"; })),
             Contains("input (1 x 5 x height x width)") && Contains("'voxel'"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.outputs[1].name = "img"; })), Contains("'image'"));
  CHECK_THAT(refusal({}), Contains("none"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) {
               h.inputs[0].shape = {"1", "n", "height", "width"};
             })),
             Contains("voxel has the shape (1 x n x height x width)"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) {
               h.inputs[0].shape = {"5", "height", "width"};
             })),
             Contains("voxel has the shape"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.outputs[1].shape[1] = "3"; })),
             Contains("image has 3 channels"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.inputs[1].name = "state"; })), Contains("state"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.outputs[0].name = "h2_out"; })),
             Contains("no output h1_out"));
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.outputs[0].shape[1] = "9"; })),
             Contains("8") && Contains("9"));
  for (const char* const axis : {"height/3x", "height/0", "tall", "", "130"}) {
    CHECK_THAT(refusal(changed([&](OnnxHeader& h) { h.inputs[1].shape[2] = axis; })),
               Contains("no whole part"));
  }
  CHECK_THAT(refusal(changed([](OnnxHeader& h) { h.inputs[1].shape[2] = "height"; })),
             Contains("no whole part"));
}

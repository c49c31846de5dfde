// The ONNX files that scripts/export_onnx makes, run by OpenCV, beside test/scripts/reference.py: the
// networks' equations in double precision, straight from the checkpoints' tensors.

#include "esi/recon/network_model.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "esi/core/error.hpp"
#include "support/run_tool.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr int kFrames = 10;
constexpr int kHeight_px = 16;
constexpr int kWidth_px = 24;

/// Runs make_network_cases.py. Where Debian's python3-numpy or python3-onnx is missing, that is an error.
void make_cases(const std::string& arguments) {
  const auto script = test::source_dir() / "test" / "scripts" / "make_network_cases.py";
  const test::ToolResult result = test::run_shell(test::quoted(script.string()) + " " + arguments);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
}

cv::Mat floats_of(const std::filesystem::path& file, const std::vector<int>& shape) {
  const std::string bytes = test::content_of(file);
  cv::Mat values(shape, CV_32F);
  REQUIRE(bytes.size() == values.total() * sizeof(float));
  std::memcpy(values.data, bytes.data(), bytes.size());
  return values;
}

cv::Mat voxel_of(const cv::Mat& voxels, int k) {
  const std::array<int, 4> shape{1, voxels.size[1], voxels.size[2], voxels.size[3]};
  return cv::Mat(4, shape.data(), CV_32F, const_cast<float*>(voxels.ptr<float>(k))).clone();
}

NetworkModel model_of(const std::filesystem::path& folder) {
  return {test::content_of(folder / "model.onnx"), "model", kHeight_px, kWidth_px};
}

void check_case(const std::filesystem::path& folder) {
  INFO(folder.filename());
  const cv::Mat voxels = floats_of(folder / "voxels.f32", {kFrames, 5, kHeight_px, kWidth_px});
  const cv::Mat images = floats_of(folder / "images.f32", {kFrames, kHeight_px, kWidth_px});
  NetworkModel model = model_of(folder);
  for (int k = 0; k < kFrames; ++k) {
    INFO("frame " << k);
    const cv::Mat1f expected(kHeight_px, kWidth_px, const_cast<float*>(images.ptr<float>(k)));
    const cv::Mat1f& image = model.run(voxel_of(voxels, k));
    CHECK(cv::norm(image, expected, cv::NORM_INF) <= 1e-5);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(expected, mean, deviation);
    REQUIRE(deviation[0] > 0.01);  // there is something to compare
  }
}

}  // namespace

TEST_CASE("networks of random weights give what their equations give, and know the sizes they can take") {
  const test::TempFolder folder;
  make_cases(test::quoted(folder.path().string()));
  for (const char* const name : {"firenet", "firenet_plus", "e2vid", "e2vid_upsampling", "e2vid_gru"}) {
    check_case(folder / name);
  }
  const std::string e2vid = test::content_of(folder / "e2vid" / "model.onnx");
  CHECK(NetworkForm::of(read_onnx_header(e2vid)).size_multiple_px() == 8);
  CHECK_THROWS_WITH(NetworkModel(e2vid, "model", 12, 24), Contains("multiples of 8 px: set pad_multiple"));
}

TEST_CASE("the published FireNet and FireNet+ give what their equations give, over ten recurrent frames") {
  for (const auto& [name, file] :
       {std::pair("firenet", "firenet_1000.pth.tar"), std::pair("firenet_plus", "firenet_plus.pth")}) {
    const auto checkpoint = test::shared_data(std::string("../weights/") + file);
    if (!checkpoint) continue;
    const test::TempFolder folder;
    make_cases(test::quoted(folder.path().string()) + " " + name + " " + test::quoted(checkpoint->string()));
    check_case(folder / name);
  }
}

namespace {

std::string tiny_network() {
  return test::content_of(test::source_dir() / "test" / "models" / "tiny_network.onnx");
}

cv::Mat random_voxel(int height_px, int width_px, int seed) {
  cv::Mat voxel(std::vector<int>{1, 5, height_px, width_px}, CV_32F);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(voxel, cv::RNG::NORMAL, 0.0, 1.0);
  return voxel;
}

}  // namespace

TEST_CASE("a network remembers, starts from zeros, and is its own") {
  const cv::Mat voxel = random_voxel(32, 48, 1);
  NetworkModel model(tiny_network(), "tiny", 32, 48);
  const cv::Mat1f first = model.run(voxel).clone();
  const cv::Mat1f second = model.run(voxel).clone();
  CHECK(cv::norm(first, second, cv::NORM_INF) > 0.01);
  NetworkModel other(tiny_network(), "tiny", 32, 48);
  CHECK(cv::norm(other.run(voxel), first, cv::NORM_INF) == 0.0);
  NetworkModel moved = std::move(other);
  CHECK(cv::norm(moved.run(voxel), second, cv::NORM_INF) == 0.0);
}

TEST_CASE("a network gives the same bits on one thread as on all") {
  const cv::Mat voxel = random_voxel(96, 112, 2);
  const auto second_image = [&] {
    NetworkModel model(tiny_network(), "tiny", 96, 112);
    model.run(voxel);
    return model.run(voxel).clone();
  };
  const cv::Mat1f on_all = second_image();
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat1f on_one = second_image();
  cv::setNumThreads(threads);
  CHECK(cv::norm(on_all, on_one, cv::NORM_INF) == 0.0);
}

TEST_CASE("a model that is none is an error in one line that names it") {
  const std::string whole = tiny_network();
  const auto refusal = [](const std::string& bytes) {
    try {
      NetworkModel(bytes, "some.onnx", 16, 16).run(random_voxel(16, 16, 3));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const std::string& bytes :
       {std::string(), std::string("hello"), std::string(1000, '\0'), whole.substr(0, 2000)}) {
    CHECK_THAT(refusal(bytes), StartsWith("some.onnx: ") && Contains("no ONNX model") && !Contains("\n"));
  }
  std::string unknown_layer = whole;
  unknown_layer.replace(unknown_layer.find("Sigmoid"), 7, "Sigmoie");
  CHECK_THAT(refusal(unknown_layer),
             StartsWith("some.onnx: ") && Contains("OpenCV can't") && !Contains("\n"));
  // The voxel grid's shape (axis 2, its value 5) says 6 bins; the weights are made for 5.
  std::string six_bins = whole;
  const std::size_t voxel = six_bins.rfind("voxel");
  const std::size_t bins = six_bins.find("\x08\x05", voxel);
  REQUIRE(bins < voxel + 40);
  six_bins[bins + 1] = '\x06';
  CHECK(NetworkForm::of(read_onnx_header(six_bins)).bins == 6);
  CHECK_THAT(refusal(six_bins), !Contains("\n"));
}

TEST_CASE("a model of one size takes no other") {
  // "height" as a number: the symbol (field 2) becomes a value (field 1) of 32 and something unknown (field
  // 3).
  std::string tall = tiny_network();
  const std::size_t height = tall.find("\x12\x06height", tall.rfind("voxel"));
  tall.replace(height, 8, std::string("\x08\x20\x1A\x04tall", 8));
  for (const char* const name : {"h1_in", "h2_in", "h1_out", "h2_out"}) {
    const std::size_t place = tall.find("\x12\x06height", tall.rfind(name));
    tall.replace(place, 8, std::string("\x08\x20\x1A\x04tall", 8));
  }
  CHECK(NetworkModel(tall, "tall", 32, 48).form().height_px == 32);
  CHECK_THROWS_WITH(NetworkModel(tall, "tall", 48, 48), StartsWith("tall: ") &&
                                                            Contains("a width of any and a height of 32") &&
                                                            Contains("48 x 48"));
}

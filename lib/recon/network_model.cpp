#include "esi/recon/network_model.hpp"

#include <fmt/format.h>

#include <array>
#include <mutex>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <string>
#include <utility>
#include <vector>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// OpenCV's importer prints what it dislikes. Its log level belongs to the whole process, hence the lock.
class QuietOpenCv {
 public:
  QuietOpenCv() : lock_(mutex()) { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(before_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  std::lock_guard<std::mutex> lock_;
  cv::utils::logging::LogLevel before_ = cv::utils::logging::getLogLevel();
};

/// The reason in one line, without OpenCV's file and line numbers.
std::string reason_of(const cv::Exception& error) {
  std::string reason = error.err;
  for (char& c : reason) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return reason.substr(0, 200);
}

cv::dnn::Net load(std::string_view bytes) {
  const QuietOpenCv quiet;
  try {
    return cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  } catch (const cv::Exception& error) {
    throw Error("OpenCV can't load it: " + reason_of(error));
  }
}

void check_size(const NetworkForm& form, int height_px, int width_px) {
  const bool fits = (form.height_px == 0 || form.height_px == height_px) &&
                    (form.width_px == 0 || form.width_px == width_px);
  if (!fits) {
    const auto side = [](int length_px) { return length_px == 0 ? "any" : std::to_string(length_px); };
    throw Error(
        fmt::format("it takes a width of {} and a height of {} px only, and the padded image has {} x {}",
                    side(form.width_px), side(form.height_px), width_px, height_px));
  }
  const int multiple = form.size_multiple_px();
  if (height_px % multiple != 0 || width_px % multiple != 0) {
    throw usage_error(fmt::format("it needs sides that are multiples of {} px: set pad_multiple", multiple));
  }
}

}  // namespace

struct NetworkModel::Impl {
  std::string name;
  NetworkForm form;
  cv::dnn::Net net;
  std::vector<cv::Mat> states;
  std::vector<cv::String> outputs{"image"};  ///< then the states'
  cv::Mat1f image;

  Impl(std::string_view bytes, std::string given_name, int height_px, int width_px)
      : name(std::move(given_name)), form(NetworkForm::of(read_onnx_header(bytes))) {
    check_size(form, height_px, width_px);
    net = load(bytes);
    for (const NetworkForm::State& state : form.states) {
      const std::array<int, 4> shape{1, state.channels, height_px / state.scale, width_px / state.scale};
      states.emplace_back(4, shape.data(), CV_32F, cv::Scalar(0));
      outputs.push_back(state.output);
    }
    try_out(height_px, width_px);
  }

  /// A step on an empty grid that leaves no trace: what doesn't fit together is found before a recording is
  /// read, and OpenCV's printing about it kept back.
  void try_out(int height_px, int width_px) {
    const QuietOpenCv quiet;
    const std::array<int, 4> shape{1, form.bins, height_px, width_px};
    step(cv::Mat(4, shape.data(), CV_32F, cv::Scalar(0)));
    for (cv::Mat& state : states) state.setTo(0.0F);
  }

  void step(const cv::Mat& voxel) {
    net.setInput(voxel, "voxel");
    for (std::size_t i = 0; i < states.size(); ++i) net.setInput(states[i], form.states[i].input);
    std::vector<cv::Mat> results;
    net.forward(results, outputs);
    const cv::Mat& shown = results.front();
    if (shown.dims != 4 || shown.size[2] != voxel.size[2] || shown.size[3] != voxel.size[3]) {
      throw Error("its image has another size than its voxel grid");
    }
    cv::Mat(shown.size[2], shown.size[3], CV_32F, results.front().ptr<float>()).copyTo(image);
    if (!cv::checkRange(image)) throw Error("its image holds values that are not finite");
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (results[i + 1].size != states[i].size) {
        throw Error(fmt::format("its {} has another size than {}", outputs[i + 1], form.states[i].input));
      }
      results[i + 1].copyTo(states[i]);
    }
  }
};

namespace {

/// Runs something, with the model's name put before what goes wrong.
template <class Action>
auto naming(const std::string& name, Action action) {
  try {
    return action();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()), error.kind());
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("{}: OpenCV can't run it: {}", name, reason_of(error)));
  } catch (const std::bad_alloc&) {
    throw Error(fmt::format("{}: there is not enough memory to run it", name));
  }
}

}  // namespace

NetworkModel::NetworkModel(std::string_view bytes, std::string name, int height_px, int width_px)
    : impl_(naming(name, [&] { return std::make_unique<Impl>(bytes, name, height_px, width_px); })) {}

NetworkModel::~NetworkModel() = default;
NetworkModel::NetworkModel(NetworkModel&&) noexcept = default;
NetworkModel& NetworkModel::operator=(NetworkModel&&) noexcept = default;

const NetworkForm& NetworkModel::form() const { return impl_->form; }

const cv::Mat1f& NetworkModel::run(const cv::Mat& voxel) {
  naming(impl_->name, [&] { impl_->step(voxel); });
  return impl_->image;
}

}  // namespace esi

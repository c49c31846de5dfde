#include "esi/io/hdf5/mvsec_images.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Of one image, and of the images that are decoded together.
constexpr std::uint64_t kMostBytes = kLargestChunkBytes;
constexpr std::uint64_t kBlockTimes = 1024;

void require_type(const Hdf5Dataset& dataset, H5T_class_t kind, std::size_t most_bytes, int rank) {
  const Hdf5Lock lock;
  const Hdf5Handle type = dataset.type();
  const bool is_right = H5Tget_class(type.get()) == kind && H5Tget_size(type.get()) <= most_bytes;
  if (is_right && dataset.shape().rank == rank) return;
  throw Error(fmt::format("{} does not hold {}", dataset.where(),
                          rank == 3 ? "images of 8 bits" : "a column of floating-point seconds"));
}

}  // namespace

MvsecImages::MvsecImages(const Hdf5File& file, const std::string& images_path, const std::string& times_path)
    : images_(file, images_path, {kMostHdf5Dimensions, kMostBytes}), times_(file, times_path) {
  require_type(images_, H5T_INTEGER, 1, 3);
  require_type(times_, H5T_FLOAT, sizeof(double), 1);
  const Hdf5Extent& extent = images_.shape().extent;
  if (std::max(extent[1], extent[2]) > static_cast<hsize_t>(kMaxSensorSide_px))
    throw Error(fmt::format("{} holds images of {}x{}", images_.where(), extent[2], extent[1]));
  if (images_.rows() != times_.rows()) {
    throw Error(fmt::format("{} has {} images, but {} has {} times", images_.where(), images_.rows(),
                            times_.path(), times_.rows()));
  }
  const std::uint64_t most = std::max<std::uint64_t>(kMostBytes / images_.shape().row_bytes(), 1);
  block_images_ = std::clamp<std::uint64_t>(images_.shape().chunk_rows(), 1, most);
}

SensorSize MvsecImages::size() const {
  return {static_cast<int>(images_.shape().extent[2]), static_cast<int>(images_.shape().extent[1])};
}

std::optional<double> MvsecImages::seconds(std::uint64_t index) {
  if (index >= times_.rows()) return std::nullopt;
  if (index - times_begin_ < loaded_times_.size()) return loaded_times_[index - times_begin_];
  const std::uint64_t end = times_.first_gap(index, std::min(index + kBlockTimes, times_.rows()));
  loaded_times_.resize(end - index);
  times_begin_ = index;
  if (end == index) throw Error(fmt::format("{}: row {} is not stored", times_.where(), index));
  if (const auto reason = times_.read(index, end - index, H5T_NATIVE_DOUBLE, loaded_times_.data()))
    throw Error(fmt::format("{}, row {}: {}", times_.where(), index, *reason));
  return loaded_times_.front();
}

cv::Mat MvsecImages::image(std::uint64_t index) {
  if (index < loaded_begin_ || index >= loaded_end_) load_images(index);
  const SensorSize sensor = size();
  const std::size_t bytes = images_.shape().row_bytes();
  return cv::Mat(sensor.height_px, sensor.width_px, CV_8UC1, loaded_.data() + (index - loaded_begin_) * bytes)
      .clone();
}

void MvsecImages::load_images(std::uint64_t index) {
  const std::uint64_t declared_end = std::min(index - index % block_images_ + block_images_, images_.rows());
  const std::uint64_t end = images_.first_gap(index, declared_end);
  loaded_begin_ = loaded_end_ = index;
  if (end == index) throw Error(fmt::format("{}: row {} is not stored", images_.where(), index));
  loaded_.resize((end - index) * images_.shape().row_bytes());
  if (const auto reason = images_.read(index, end - index, H5T_NATIVE_UINT8, loaded_.data()))
    throw Error(fmt::format("{}, row {}: {}", images_.where(), index, *reason));
  loaded_end_ = end;
}

}  // namespace esi

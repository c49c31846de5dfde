#include "esi/io/hdf5/monash_images.hpp"

#include <fmt/format.h>

#include <limits>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/attributes.hpp"
#include "esi/io/hdf5/dataset.hpp"

namespace esi {
namespace {

constexpr int kColours = 3;

std::string path_of(std::uint64_t index) { return fmt::format("/images/image{:09}", index); }

int channels_of(const Hdf5Dataset& dataset) {
  const Hdf5Lock lock;
  const Hdf5Handle type = dataset.type();
  const Hdf5Shape& shape = dataset.shape();
  const bool is_bytes = H5Tget_class(type.get()) == H5T_INTEGER && shape.value_bytes == 1;
  const bool is_grey = shape.rank == 2 || (shape.rank == 3 && shape.extent[2] == 1);
  const bool is_colour = shape.rank == 3 && shape.extent[2] == kColours;
  constexpr auto kMostSide = static_cast<hsize_t>(kMaxSensorSide_px);
  const bool is_small = shape.rows() > 0 && shape.rows() <= kMostSide && shape.extent[1] <= kMostSide &&
                        shape.rows() * shape.row_bytes() <= kLargestChunkBytes;
  if (is_bytes && is_small && (is_grey || is_colour)) return is_colour ? kColours : 1;
  throw Error(dataset.where() + " is no image of 8 bits, grey or with three colours");
}

}  // namespace

std::optional<double> MonashImages::seconds(std::uint64_t index) {
  if (!file_.has_dataset(path_of(index))) return std::nullopt;
  const auto time = numeric_attribute(file_, path_of(index), "timestamp", 1);
  return time ? time->front() : std::numeric_limits<double>::quiet_NaN();
}

cv::Mat MonashImages::image(std::uint64_t index) {
  Hdf5Dataset dataset(file_, path_of(index), {kMostHdf5Dimensions, kLargestChunkBytes});
  const int channels = channels_of(dataset);
  const std::uint64_t rows = dataset.rows();
  if (dataset.first_gap(0, rows) < rows) throw Error(dataset.where() + " is not stored completely");
  cv::Mat image(static_cast<int>(rows), static_cast<int>(dataset.shape().extent[1]), CV_8UC(channels));
  if (const auto reason = dataset.read(0, rows, H5T_NATIVE_UINT8, image.data))
    throw Error(dataset.where() + ": " + *reason);
  return image;
}

}  // namespace esi

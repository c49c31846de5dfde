#pragma once

#include <string>

#include "esi/io/hdf5/file.hpp"
#include "esi/io/hdf5/images.hpp"

namespace esi {

/// Intensity frames as datasets /images/image000000000, ...001 and so on: height x width bytes, grey, or
/// three of them a pixel, blue first. The attribute `timestamp` of each has its time in seconds.
class MonashImages final : public Hdf5Images {
 public:
  /// The file must outlive this.
  explicit MonashImages(const Hdf5File& file) : file_(file) {}

  std::optional<double> seconds(std::uint64_t index) override;
  cv::Mat image(std::uint64_t index) override;

 private:
  const Hdf5File& file_;
};

}  // namespace esi

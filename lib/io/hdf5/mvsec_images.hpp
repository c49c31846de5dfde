#pragma once

#include <string>
#include <vector>

#include "esi/io/hdf5/dataset.hpp"
#include "esi/io/hdf5/images.hpp"

namespace esi {

/// Intensity frames as one dataset of N x height x width bytes and another of N times in seconds.
class MvsecImages final : public Hdf5Images {
 public:
  /// Throws an Error where the datasets are of another kind.
  MvsecImages(const Hdf5File& file, const std::string& images_path, const std::string& times_path);

  SensorSize size() const;
  std::optional<double> seconds(std::uint64_t index) override;
  cv::Mat image(std::uint64_t index) override;

 private:
  void load_images(std::uint64_t index);

  Hdf5Dataset images_, times_;
  std::uint64_t block_images_ = 1;  ///< decoded together
  std::uint64_t loaded_begin_ = 0, loaded_end_ = 0;
  std::vector<std::uint8_t> loaded_;
  std::uint64_t times_begin_ = 0;
  std::vector<double> loaded_times_;
};

}  // namespace esi

#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "esi/io/output/output_file.hpp"

namespace esi {

/// A folder of its own for frame_0000000000.png and so on, with images.txt ("<seconds>
/// frame_0000000000.png"), which appears with commit().
class NumberedPictures {
 public:
  /// Makes the folder. Throws an Error where that fails.
  explicit NumberedPictures(std::filesystem::path folder);

  void add(const cv::Mat1b& grey, std::int64_t t_us);
  void commit() { list_.commit(); }

  const std::filesystem::path& path() const { return folder_; }
  std::int64_t size() const { return size_; }

 private:
  std::filesystem::path folder_;
  OutputFile list_;
  std::int64_t size_ = 0;
};

}  // namespace esi

#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "esi/io/output/output_file.hpp"

namespace esi {

/// images/ and images.txt of a text recording: they grow beside their places and appear with commit(),
/// without which they are removed. As long as there is no picture, neither is made.
class PictureFolder {
 public:
  /// Throws a usage Error where one of them is there already.
  explicit PictureFolder(const std::filesystem::path& parent);
  ~PictureFolder();
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  /// As images/frame_00000000.png and so on.
  void add(const cv::Mat1b& grey, std::int64_t t_us);
  void commit();
  /// Takes back what commit() did.
  void withdraw() noexcept;

 private:
  void make_part();

  std::filesystem::path folder_, part_, list_path_;
  std::optional<OutputFile> list_;
  std::int64_t pictures_ = 0;
  bool has_part_ = false, is_in_place_ = false;
};

}  // namespace esi

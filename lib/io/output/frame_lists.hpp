#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "esi/core/frame.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {

/// "frame_0000000042.png"
std::string frame_file_name(std::int64_t index);

/// The lists of a folder's frames: timestamps.txt, images.txt and frames.csv. They appear at commit().
class FrameLists {
 public:
  explicit FrameLists(const std::filesystem::path& folder);

  /// In the order of the frames; the image isn't looked at.
  void add(const Frame& frame);
  void commit();

  /// How many frames are in the lists.
  std::int64_t size() const { return size_; }

 private:
  OutputFile timestamps_, images_, frames_;
  std::int64_t size_ = 0;
};

}  // namespace esi

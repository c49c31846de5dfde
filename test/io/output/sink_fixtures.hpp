#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/core/frame.hpp"

namespace esi::test {

/// Grey levels that neither filter nor run length makes small, different for each index.
inline cv::Mat1b noise(std::int64_t index, int width, int height) {
  cv::Mat1b grey(height, width);
  cv::RNG random(static_cast<std::uint64_t>(index) + 1);
  random.fill(grey, cv::RNG::UNIFORM, 0, 256);
  return grey;
}

/// Frame k of a made-up run: due at (k + 1) * 10 ms.
inline Frame frame_of(std::int64_t index, const cv::Mat1b& grey) {
  return {index, (index + 1) * 10000, 3 * index, grey};
}

/// File size limit (RLIMIT_FSIZE), which stands for a full disk: writes come back short, then fail.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uintmax_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

/// Sorted names of all that is in a folder.
inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// What an action throws as an Error; fails the test when it throws nothing.
inline Error error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  FAIL("nothing was thrown");
  return Error("");
}

/// A place where nobody may make a file, root neither.
inline constexpr const char* kReadOnlyFolder = "/sys";

}  // namespace esi::test

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace esi::test {

/// A new folder that goes away with its owner.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// Writes a file into it; returns the path.
  std::filesystem::path write(const std::string& name, std::string_view content) const;

 private:
  std::filesystem::path path_;
};

/// A file's bytes as text.
std::string content_of(const std::filesystem::path& path);

}  // namespace esi::test

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "esi/io/output/file_descriptor.hpp"

namespace esi {

/// A file of lines that only grows: each is on the disk when append() returns, and what a kill tears off is
/// the last one. One run at a time holds it, by an advisory lock that ends with the process.
class JournalFile {
 public:
  /// Opens the file, or makes it; cuts a last line off that has no end. Throws an Error when another run
  /// holds it: `what` says of what.
  JournalFile(std::filesystem::path path, const std::string& what);

  /// What was there on opening.
  const std::vector<std::string>& lines() const { return lines_; }

  /// A line, or several with line breaks between. Throws an Error with the path and the system's reason; the
  /// file then ends in a part of them at most, and takes nothing more.
  void append(std::string_view lines);

 private:
  void read_lines();

  std::filesystem::path path_;
  FileDescriptor file_;
  std::vector<std::string> lines_;
};

/// The lines of a journal that nobody writes any more, without a torn last one.
std::vector<std::string> read_journal(const std::filesystem::path& path);

}  // namespace esi

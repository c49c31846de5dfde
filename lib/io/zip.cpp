#include "esi/io/zip.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <cstring>
#include <string_view>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr std::string_view kSignature = "PK\x03\x04";
constexpr std::string_view kEmptySignature = "PK\x05\x06";

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using Entry = std::unique_ptr<zip_file_t, CloseEntry>;

class ZipEntryStream final : public ByteStream {
 public:
  ZipEntryStream(Archive archive, Entry entry) : archive_(std::move(archive)), entry_(std::move(entry)) {}

  std::size_t read(std::span<std::byte> target) override {
    if (!damage_.empty()) return 0;
    const zip_int64_t n = zip_fread(entry_.get(), target.data(), target.size());
    if (n >= 0) return static_cast<std::size_t>(n);
    damage_ = zip_error_strerror(zip_file_get_error(entry_.get()));
    return 0;
  }

  std::string damage() const override { return damage_; }

 private:
  Archive archive_;
  Entry entry_;
  std::string damage_;
};

Archive open_archive(const ByteSource& bytes) {
  if (bytes.is_stdin()) {
    throw Error(bytes.name() +
                ": a zip archive cannot be read as a stream; give the file's path, or unzip -p");
  }
  int code = 0;
  Archive archive(zip_open(bytes.path().c_str(), ZIP_RDONLY, &code));
  if (archive) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw Error(fmt::format("{}: the zip archive cannot be opened ({}); copy it again", bytes.name(), reason));
}

/// Folders, and what macOS adds to archives, are no recordings.
bool is_recording(std::string_view entry) { return !entry.ends_with('/') && !entry.starts_with("__MACOSX/"); }

zip_uint64_t only_entry(zip_t* archive, const std::string& name) {
  zip_int64_t found = -1;
  int files = 0;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    const char* const entry = zip_get_name(archive, static_cast<zip_uint64_t>(i), ZIP_FL_ENC_RAW);
    if (entry == nullptr || !is_recording(entry)) continue;
    found = i;
    ++files;
  }
  if (files != 1) {
    throw Error(fmt::format("{}: the zip archive holds {} files; it must hold one, a recording as text", name,
                            files));
  }
  return static_cast<zip_uint64_t>(found);
}

}  // namespace

bool looks_like_zip(std::span<const std::byte> head) {
  return head.size() >= kSignature.size() &&
         (std::memcmp(head.data(), kSignature.data(), kSignature.size()) == 0 ||
          std::memcmp(head.data(), kEmptySignature.data(), kEmptySignature.size()) == 0);
}

std::unique_ptr<ByteSource> open_zip_entry(const ByteSource& archive) {
  Archive opened = open_archive(archive);
  const zip_uint64_t index = only_entry(opened.get(), archive.name());
  Entry entry(zip_fopen_index(opened.get(), index, 0));
  if (!entry) {
    throw Error(fmt::format("{}: the file in the zip archive cannot be read ({}); unzip it first",
                            archive.name(), zip_error_strerror(zip_get_error(opened.get()))));
  }
  return std::make_unique<ByteSource>(archive.path(),
                                      std::make_unique<ZipEntryStream>(std::move(opened), std::move(entry)));
}

}  // namespace esi

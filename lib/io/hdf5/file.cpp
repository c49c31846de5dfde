#include "esi/io/hdf5/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>

#include "esi/core/error.hpp"
#include "esi/io/format_reader.hpp"

namespace esi {
namespace {

constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t kNoSignature = static_cast<std::size_t>(-1);
constexpr std::size_t kLongestName = 80;
constexpr std::size_t kCacheSlots = 31;  // A prime; few chunks are ever kept.
constexpr double kDropReadChunksFirst = 1.0;

std::size_t signature_offset(std::span<const std::byte> head) {
  for (const std::size_t offset : {0U, 512U, 1024U, 2048U}) {
    if (head.size() >= offset + kSignature.size() &&
        std::memcmp(head.data() + offset, kSignature.data(), kSignature.size()) == 0) {
      return offset;
    }
  }
  return kNoSignature;
}

/// Superblock version 3 has file consistency flags: byte 8 is the version; byte 11 has bit 0 for a writer,
/// bit 2 for a single writer with many readers.
bool is_marked_as_written(std::span<const std::byte> head) {
  const std::size_t offset = signature_offset(head);
  if (offset == kNoSignature || head.size() < offset + 12) return false;
  return head[offset + 8] == std::byte{3} && (head[offset + 11] & std::byte{0b101}) != std::byte{0};
}

Hdf5Handle file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // Folders on which nothing can be locked (read-only, NFS) are no reason to fail.
  H5Pset_file_locking(access.get(), true, true);
  return access;
}

/// Names in hostile files may be long and hold line breaks.
std::string printable(const char* name) {
  std::string text(name, strnlen(name, kLongestName));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return text;
}

/// HDF5 calls this before it follows a link into another file; a negative value stops it.
herr_t stop_at_external_link(const char* /*file*/, const char* /*group*/, const char* target_file,
                             const char* /*target*/, unsigned* /*flags*/, hid_t /*access*/, void* data) {
  *static_cast<std::string*>(data) = printable(target_file);
  return -1;
}

struct PathCollector {
  std::vector<std::string> paths;
  std::size_t limit;
};

herr_t collect_dataset(hid_t /*root*/, const char* path, const H5O_info_t* info, void* data) {
  auto& collector = *static_cast<PathCollector*>(data);
  if (info->type != H5O_TYPE_DATASET) return 0;
  collector.paths.push_back("/" + printable(path));
  return collector.paths.size() < collector.limit ? 0 : 1;
}

Hdf5Handle open_file(const ByteSource& bytes) {
  const Hdf5Handle access = file_access();
  Hdf5Handle file(H5Fopen(bytes.path().c_str(), H5F_ACC_RDONLY, access.get()));
  if (file) return file;
  const Hdf5Failure failure = last_hdf5_failure();
  if (failure.truncated) {
    throw Error(fmt::format("{}: is truncated, copy it again ({})", bytes.name(), failure.reason));
  }
  throw Error(fmt::format("{}: cannot be opened as HDF5 ({})", bytes.name(), failure.reason));
}

}  // namespace

bool has_hdf5_signature(std::span<const std::byte> head) { return signature_offset(head) != kNoSignature; }

Hdf5File::Hdf5File(ByteSource& bytes) : name_(bytes.name()), link_target_(std::make_unique<std::string>()) {
  if (!bytes.file_bytes()) {
    throw Error(name_ +
                ": holds HDF5, which cannot be read as a stream or in an archive; give the file's path");
  }
  if (is_marked_as_written(bytes.peek(kFormatHeadBytes))) {
    throw Error(name_ +
                ": was not closed properly, or is still being written; once nobody writes to it, run "
                "h5clear -s on a copy");
  }
  std::error_code unknown;
  size_bytes_ = std::filesystem::file_size(bytes.path(), unknown);
  if (unknown) throw Error(fmt::format("{}: its size cannot be told ({})", name_, unknown.message()));
  const Hdf5Lock lock;
  file_ = open_file(bytes);
}

bool Hdf5File::has_dataset(const std::string& path) const {
  const Hdf5Lock lock;
  const Hdf5Handle object = open_object(path);
  return object && H5Iget_type(object.get()) == H5I_DATASET;
}

Hdf5Handle Hdf5File::open_object(const std::string& path) const {
  const Hdf5Handle access(H5Pcreate(H5P_LINK_ACCESS));
  H5Pset_elink_cb(access.get(), stop_at_external_link, link_target_.get());
  Hdf5Handle object(H5Oopen(file_.get(), path.c_str(), access.get()));
  refuse_external_link(path);
  return object;
}

Hdf5Handle Hdf5File::open_dataset(const std::string& path, std::size_t chunk_cache_bytes) const {
  const Hdf5Lock lock;
  const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_elink_cb(access.get(), stop_at_external_link, link_target_.get());
  H5Pset_chunk_cache(access.get(), kCacheSlots, chunk_cache_bytes, kDropReadChunksFirst);
  Hdf5Handle dataset(H5Dopen2(file_.get(), path.c_str(), access.get()));
  if (dataset) return dataset;
  const std::string reason = last_hdf5_failure().reason;
  refuse_external_link(path);
  throw Error(fmt::format("{}: dataset {} cannot be opened ({})", name_, path, reason));
}

std::vector<std::string> Hdf5File::dataset_paths(std::size_t limit) const {
  const Hdf5Lock lock;
  PathCollector collector{{}, limit};
  H5Ovisit2(file_.get(), H5_INDEX_NAME, H5_ITER_INC, collect_dataset, &collector, H5O_INFO_BASIC);
  return std::move(collector.paths);
}

void Hdf5File::refuse_external_link(const std::string& path) const {
  if (link_target_->empty()) return;
  const std::string target = std::exchange(*link_target_, {});
  throw Error(
      fmt::format("{}: {} is a link into another file ({}), which is not followed; copy the data into one "
                  "file with h5copy -f ext",
                  name_, path, target));
}

}  // namespace esi

#include "esi/io/writing/picture_folder.hpp"

#include <fmt/format.h>

#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"
#include "esi/io/output/encode_png.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

constexpr int kPngLevel = 1;

}  // namespace

PictureFolder::PictureFolder(const fs::path& parent)
    : folder_(parent / "images"), part_(parent / "images.part"), list_path_(parent / "images.txt") {
  for (const fs::path& path : {folder_, list_path_}) {
    if (!is_there(path)) continue;
    throw usage_error(
        fmt::format("{}: is there already, and would pass for this recording's; choose an empty "
                    "folder",
                    path.string()));
  }
}

PictureFolder::~PictureFolder() {
  std::error_code ignored;
  if (has_part_) fs::remove_all(part_, ignored);
}

void PictureFolder::add(const cv::Mat1b& grey, std::int64_t t_us) {
  if (!list_) make_part();
  const std::string name = fmt::format("frame_{:08}.png", pictures_++);
  const std::vector<std::uint8_t> png = encode_png(grey, kPngLevel);
  write_file(part_ / name, std::as_bytes(std::span(png)));
  list_->write(fmt::format("{} images/{}\n", seconds_text(t_us), name));
}

void PictureFolder::commit() {
  if (!list_) return;
  std::error_code error;
  fs::rename(part_, folder_, error);
  if (error) throw system_error(folder_.string(), "cannot be put in place", error.value());
  has_part_ = false;
  is_in_place_ = true;
  list_->commit();
}

void PictureFolder::withdraw() noexcept {
  std::error_code ignored;
  if (!is_in_place_) return;
  fs::remove_all(folder_, ignored);
  fs::remove(list_path_, ignored);
}

void PictureFolder::make_part() {
  std::error_code error;
  fs::remove_all(part_, error);  // a killed run may have left it
  fs::create_directory(part_, error);
  if (error) throw system_error(part_.string(), "cannot be created", error.value());
  has_part_ = true;
  list_.emplace(list_path_);
}

}  // namespace esi

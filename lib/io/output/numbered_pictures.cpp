#include "esi/io/output/numbered_pictures.hpp"

#include <span>
#include <vector>

#include "esi/core/time.hpp"
#include "esi/io/output/encode_png.hpp"
#include "esi/io/output/frame_lists.hpp"

namespace esi {
namespace {

constexpr int kPngLevel = 1;

std::filesystem::path made(std::filesystem::path folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error) throw system_error(folder.string(), "cannot be created", error.value());
  return folder;
}

}  // namespace

NumberedPictures::NumberedPictures(std::filesystem::path folder)
    : folder_(made(std::move(folder))), list_(folder_ / "images.txt") {}

void NumberedPictures::add(const cv::Mat1b& grey, std::int64_t t_us) {
  const std::string name = frame_file_name(size_++);
  const std::vector<std::uint8_t> png = encode_png(grey, kPngLevel);
  write_file(folder_ / name, std::as_bytes(std::span(png)));
  list_.write(seconds_text(t_us) + ' ' + name + '\n');
}

}  // namespace esi

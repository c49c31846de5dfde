#include "esi/io/image_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

/// So many pictures are in memory at a time, however sparse the events are.
constexpr std::size_t kMostImagesAtOnce = 16;

struct ListedImage {
  std::int64_t t_us = 0;
  fs::path file;
};

/// OpenCV prints where it meets none.
bool exists(const ListedImage& image) {
  std::error_code absent;
  return fs::is_regular_file(image.file, absent);
}

/// "<seconds> <file>"
std::optional<ListedImage> parse_line(std::string_view line, const fs::path& folder) {
  double t_s = 0;
  const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), t_s);
  line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
  const std::size_t name = line.find_first_not_of(" \t");
  constexpr double kLongest_s = 1e12;  // keeps microseconds within 64 bits
  if (error != std::errc{} || !(std::abs(t_s) < kLongest_s) || name == 0 || name == std::string_view::npos)
    return std::nullopt;
  return ListedImage{us_from_seconds(t_s), folder / line.substr(name)};
}

/// By time. Throws an Error with the line.
std::vector<ListedImage> read_list(const fs::path& path) {
  const std::string text = read_text_file(path);
  std::vector<ListedImage> images;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    auto image = parse_line(line, path.parent_path());
    if (!image) {
      throw Error(fmt::format("{}: line {} is not a time in seconds and a picture's name", path.string(),
                              line_number));
    }
    images.push_back(std::move(*image));
  }
  const auto is_earlier = [](const ListedImage& a, const ListedImage& b) { return a.t_us < b.t_us; };
  std::stable_sort(images.begin(), images.end(), is_earlier);
  return images;
}

class ReaderWithImages final : public FormatReader {
 public:
  ReaderWithImages(std::unique_ptr<FormatReader> reader, std::vector<ListedImage> images, std::string note)
      : reader_(std::move(reader)), images_(std::move(images)), note_(std::move(note)) {
    update_header();
  }

  const RecordingHeader& header() const override { return header_; }
  std::optional<double> fraction_read() const override { return reader_->fraction_read(); }

  bool read(Packet& packet, Losses& losses) override {
    if (next_event_ == pending_.events.size() && !fill(losses)) return false;
    const std::size_t enough = packet.frames.size() + kMostImagesAtOnce;
    while (next_event_ < pending_.events.size() && packet.frames.size() < enough) {
      if (move_events(packet)) add_image(packet, losses);
    }
    return true;
  }

 private:
  bool fill(Losses& losses) {
    pending_.clear();
    next_event_ = 0;
    const bool has_more = reader_->read(pending_, losses);
    if (has_more && is_at_begin_) pass_over_early_images();
    if (!has_more && next_image_ < images_.size()) {
      note_ =
          fmt::format("{} of the {} pictures in images.txt are later than the last event and are left out",
                      images_.size() - next_image_, images_.size());
    }
    update_header();
    return has_more;
  }

  /// Of those before the first event, only the last one shows what the events change.
  void pass_over_early_images() {
    is_at_begin_ = false;
    const std::int64_t t_us = pending_.events.front().t_us;
    while (next_image_ + 1 < images_.size() && images_[next_image_ + 1].t_us <= t_us) ++next_image_;
  }

  /// Up to the next picture's time; whether that was reached.
  bool move_events(Packet& packet) {
    const auto begin = pending_.events.begin() + static_cast<std::ptrdiff_t>(next_event_);
    const auto is_due = [this](const Event& event) {
      return next_image_ < images_.size() && event.t_us >= images_[next_image_].t_us;
    };
    const auto end = std::find_if(begin, pending_.events.end(), is_due);
    packet.events.insert(packet.events.end(), begin, end);
    next_event_ += static_cast<std::size_t>(end - begin);
    return end != pending_.events.end();
  }

  void add_image(Packet& packet, Losses& losses) {
    const ListedImage& image = images_[next_image_++];
    cv::Mat pixels;
    if (exists(image)) pixels = cv::imread(image.file.string(), cv::IMREAD_GRAYSCALE);
    if (pixels.empty()) {
      losses.add(Damage::unreadable_frame);
    } else {
      packet.frames.push_back({{image.t_us, image.t_us}, std::move(pixels)});
    }
  }

  void update_header() {
    header_ = reader_->header();
    header_.has_intensity_frames = !images_.empty();
    if (!note_.empty()) header_.notes.push_back(note_);
  }

  std::unique_ptr<FormatReader> reader_;
  std::vector<ListedImage> images_;
  std::size_t next_image_ = 0;
  Packet pending_;  ///< what the reader gave; handed out up to next_event_
  std::size_t next_event_ = 0;
  bool is_at_begin_ = true;
  RecordingHeader header_;
  std::string note_;
};

}  // namespace

std::unique_ptr<FormatReader> with_listed_images(std::unique_ptr<FormatReader> reader,
                                                 const fs::path& recording) {
  const fs::path list = recording.parent_path() / "images.txt";
  std::error_code absent;
  if (!fs::is_regular_file(list, absent)) return reader;
  std::vector<ListedImage> images;
  std::string note;
  try {
    images = read_list(list);
  } catch (const Error& error) {
    note = fmt::format("pictures are not used: {}", error.what());
  }
  if (!images.empty() && std::none_of(images.begin(), images.end(), exists)) {
    note = fmt::format("none of the {} pictures in images.txt is there", images.size());
    images.clear();
  }
  return std::make_unique<ReaderWithImages>(std::move(reader), std::move(images), std::move(note));
}

}  // namespace esi

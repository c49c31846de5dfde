#include "esi/io/image_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "esi/core/error.hpp"
#include "esi/io/picture_list.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

/// So many pictures are in memory at a time, however sparse the events are.
constexpr std::size_t kMostImagesAtOnce = 16;

/// OpenCV prints where it meets none.
bool exists(const ListedPicture& image) {
  std::error_code absent;
  return fs::is_regular_file(image.file, absent);
}

class ReaderWithImages final : public FormatReader {
 public:
  ReaderWithImages(std::unique_ptr<FormatReader> reader, std::vector<ListedPicture> images, std::string note)
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
    const ListedPicture& image = images_[next_image_++];
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
  std::vector<ListedPicture> images_;
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
  std::vector<ListedPicture> images;
  std::string note;
  try {
    images = read_picture_list(list);
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

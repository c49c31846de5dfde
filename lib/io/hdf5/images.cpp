#include "esi/io/hdf5/images.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/event_rows.hpp"

namespace esi {
namespace {

/// Few, as a long gap between events may have any number of frames.
constexpr std::size_t kMostFramesAtOnce = 4;

}  // namespace

Hdf5FrameTrack::Hdf5FrameTrack(const std::string& reason, std::vector<std::string>& notes) : notes_(&notes) {
  note_damage(reason);
}

bool Hdf5FrameTrack::append_until(std::int64_t t_us, Packet& packet, Losses& losses) {
  const std::size_t before = packet.frames.size();
  while (packet.frames.size() < before + kMostFramesAtOnce) {
    const auto next_us = next_time_us();
    if (!next_us || *next_us > t_us) break;
    append_next(*next_us, packet);
    ++next_;
  }
  if (damaged_ > 0) losses.add(Damage::corrupt_packet, std::exchange(damaged_, 0));
  return packet.frames.size() > before;
}

void Hdf5FrameTrack::try_out(const std::function<bool()>& go_on) {
  for (; go_on() && next_time_us(); ++next_) images_->image(next_);
}

/// Of the next frame that has a time.
std::optional<std::int64_t> Hdf5FrameTrack::next_time_us() {
  try {
    for (; images_; ++next_) {
      const auto seconds = images_->seconds(next_);
      if (!seconds) {
        images_.reset();
        break;
      }
      const std::int64_t t_us = us_or_none(*seconds);
      if (t_us != kNoTime_us) return t_us;
      note_damage(fmt::format("frame {} has no valid time", next_));
    }
  } catch (const Error& error) {
    images_.reset();
    note_damage(error.what());
  }
  return std::nullopt;
}

void Hdf5FrameTrack::append_next(std::int64_t t_us, Packet& packet) {
  try {
    cv::Mat image = images_->image(next_);
    if (image.channels() > 1) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
    if (size_ && image.size() != cv::Size(size_->width_px, size_->height_px)) {
      throw Error(fmt::format("it is {}x{}, but the sensor {}", image.cols, image.rows, to_string(*size_)));
    }
    packet.frames.push_back({{t_us, t_us}, image});
  } catch (const Error& error) {
    note_damage(fmt::format("frame {}: {}", next_, error.what()));
  }
}

void Hdf5FrameTrack::note_damage(const std::string& reason) {
  ++damaged_;
  if (!has_damage_) notes_->push_back(fmt::format("intensity frames are left out: {}", reason));
  has_damage_ = true;
}

}  // namespace esi

#include "esi/io/output/frame_lists.hpp"

#include <fmt/format.h>

#include "esi/core/time.hpp"

namespace esi {

std::string frame_file_name(std::int64_t index) { return fmt::format("frame_{:010}.png", index); }

FrameLists::FrameLists(const std::filesystem::path& folder)
    : timestamps_(folder / "timestamps.txt"), images_(folder / "images.txt"), frames_(folder / "frames.csv") {
  frames_.write("index,t_us,events_since_previous\n");
}

void FrameLists::add(const Frame& frame) {
  const std::string seconds = seconds_text(frame.t_us);
  timestamps_.write(seconds + '\n');
  images_.write(seconds + ' ' + frame_file_name(frame.index) + '\n');
  frames_.write(fmt::format("{},{},{}\n", frame.index, frame.t_us, frame.events_since_previous));
  ++size_;
}

void FrameLists::commit() {
  timestamps_.commit();
  images_.commit();
  frames_.commit();
}

}  // namespace esi

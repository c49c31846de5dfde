#include "esi/io/writing/dsec_writer.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/writing/hdf5_column_writer.hpp"

namespace esi {
namespace {

/// 11 days. The index has an entry for every millisecond from 0 on, so an epoch's time would fill the disk.
constexpr std::int64_t kMaxTime_us = 1'000'000'000'000;

class DsecWriter final : public RecordingWriter {
 public:
  DsecWriter(const std::filesystem::path& path, const WriteOptions& options)
      : name_(path.string()), output_(path), t_offset_us_(options.t_offset_us) {}

  void write(const Packet& packet) override {
    if (!packet.frames.empty()) {
      throw usage_error(name_ + ": DSEC's layout has no place for intensity frames; write an .aedat4 file");
    }
    for (const Event& event : packet.events) {
      require_possible(event.t_us);
      index_until(event.t_us);
      x_.push(event.x);
      y_.push(event.y);
      p_.push(event.on ? 1 : 0);
      t_.push(static_cast<std::uint64_t>(event.t_us));
    }
  }

  void finish() override {
    if (ms_to_idx_.rows() == 0) ms_to_idx_.push(0);
    x_.finish();
    y_.finish();
    p_.finish();
    t_.finish();
    ms_to_idx_.finish();
    write_hdf5_scalar(output_, "/t_offset", t_offset_us_);
    output_.commit();
  }

 private:
  void require_possible(std::int64_t t_us) const {
    if (t_us >= 0 && t_us <= kMaxTime_us) return;
    throw Error(
        fmt::format("{}: an event at {} us does not fit into DSEC's layout (0 to {} us); give what all "
                    "times have in common as the time offset",
                    name_, t_us, kMaxTime_us));
  }

  /// Entry ms is the first event that is not before ms milliseconds: the next one, up to its time.
  void index_until(std::int64_t t_us) {
    while (static_cast<std::int64_t>(ms_to_idx_.rows()) * 1000 <= t_us) ms_to_idx_.push(t_.rows());
  }

  std::string name_;
  Hdf5Output output_;
  std::int64_t t_offset_us_;
  Hdf5ColumnWriter<std::uint16_t> x_{output_, "/events/x"}, y_{output_, "/events/y"};
  Hdf5ColumnWriter<std::uint8_t> p_{output_, "/events/p"};
  Hdf5ColumnWriter<std::uint64_t> t_{output_, "/events/t"};
  Hdf5ColumnWriter<std::uint64_t> ms_to_idx_{output_, "/ms_to_idx"};
};

}  // namespace

std::unique_ptr<RecordingWriter> open_dsec_writer(const std::filesystem::path& path,
                                                  const WriteOptions& options) {
  return std::make_unique<DsecWriter>(path, options);
}

}  // namespace esi

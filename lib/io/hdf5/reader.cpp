#include "esi/io/hdf5/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/crash_probe.hpp"
#include "esi/io/hdf5/layout.hpp"

namespace esi {
namespace {

/// How many rows are read at once: enough to make HDF5's work per call small, few enough for the cache.
constexpr std::uint64_t kBlockRows = std::uint64_t{1} << 16;
/// Chunks that are longer are read in parts; HDF5 keeps the decoded chunk meanwhile.
constexpr std::uint64_t kLargestBlockRows = std::uint64_t{1} << 20;
/// CPU time for what is looked up ahead of reading: enough for some 10^5 chunks.
constexpr double kTryOut_s = 0.2;

class Hdf5Reader final : public FormatReader {
 public:
  Hdf5Reader(ByteSource& bytes, const ReadOptions& options);

  const RecordingHeader& header() const override { return header_; }
  bool read(Packet& packet, Losses& losses) override;
  std::optional<double> fraction_read() const override;

  /// What opening and reading may meet in the file's metadata, within 0.2 s; for the child process that
  /// crashes in our place. Spends the reader.
  void try_out();

 private:
  bool append_frames_until(std::int64_t t_us, Packet& packet, Losses& losses);
  bool load_block(Losses& losses);
  std::uint64_t block_end() const;
  void end_at_gap(Losses& losses);
  void pass_over(std::uint64_t end, const std::string& reason, Losses& losses);

  RecordingHeader header_;
  Hdf5File file_;
  Hdf5Content content_;
  std::uint64_t rows_ = 0;  ///< declared; less once it shows that not all are stored
  std::uint64_t chunk_rows_ = 0;
  std::uint64_t block_rows_ = 0;  ///< a whole number of chunks, or a part of one
  std::uint64_t loaded_begin_ = 0, loaded_end_ = 0;
  std::uint64_t row_ = 0;               ///< the next to be given out
  std::int64_t newest_us_ = INT64_MIN;  ///< of the events given out
  bool has_damage_ = false;
};

Hdf5Reader::Hdf5Reader(ByteSource& bytes, const ReadOptions& options) : file_(bytes) {
  const Hdf5Layout& layout = find_hdf5_layout(file_);
  header_.format = "hdf5";
  header_.layout = layout.name;
  content_ = layout.open(file_, options, header_);
  rows_ = content_.events->rows();
  chunk_rows_ = std::max<std::uint64_t>(content_.events->chunk_rows(), 1);
  block_rows_ = std::max(kBlockRows - kBlockRows % chunk_rows_, chunk_rows_);
}

// Frames follow the events that pass them, before any later events.
bool Hdf5Reader::read(Packet& packet, Losses& losses) {
  if (append_frames_until(newest_us_, packet, losses)) return true;
  while (row_ == loaded_end_) {
    if (row_ == rows_) return append_frames_until(INT64_MAX, packet, losses);
    if (!load_block(losses)) continue;
  }
  const std::size_t before = packet.events.size();
  const std::uint64_t count = std::min<std::uint64_t>(kPacketEvents, loaded_end_ - row_);
  content_.events->append(row_ - loaded_begin_, count, packet, losses);
  row_ += count;
  for (std::size_t i = before; i < packet.events.size(); ++i)
    newest_us_ = std::max(newest_us_, packet.events[i].t_us);
  append_frames_until(newest_us_, packet, losses);
  return true;
}

bool Hdf5Reader::append_frames_until(std::int64_t t_us, Packet& packet, Losses& losses) {
  return content_.frames && content_.frames->append_until(t_us, packet, losses);
}

void Hdf5Reader::try_out() {
  const std::clock_t end = std::clock() + static_cast<std::clock_t>(kTryOut_s * CLOCKS_PER_SEC);
  const auto go_on = [end] { return std::clock() < end; };
  for (std::uint64_t row = 0; row < rows_ && go_on();) {
    const std::uint64_t next = std::min(row + kBlockRows, rows_);
    if (content_.events->first_gap(row, next) < next) break;
    row = next;
  }
  const auto frames = std::move(content_.frames);
  Packet packet;
  Losses losses;
  read(packet, losses);
  if (frames) frames->try_out(go_on);
}

std::optional<double> Hdf5Reader::fraction_read() const {
  return rows_ == 0 ? 1.0 : static_cast<double>(row_) / static_cast<double>(rows_);
}

/// The end of the block that begins at row_. Chunks begin at multiples of their length, and so do blocks.
std::uint64_t Hdf5Reader::block_end() const {
  const std::uint64_t end = row_ - row_ % block_rows_ + block_rows_;
  return std::min({end, row_ + kLargestBlockRows, rows_});
}

bool Hdf5Reader::load_block(Losses& losses) {
  const std::uint64_t declared_end = block_end();
  const std::uint64_t end = content_.events->first_gap(row_, declared_end);
  if (end < declared_end) {
    rows_ = end;
    end_at_gap(losses);
    if (row_ == rows_) return false;
  }
  const auto reason = content_.events->load(row_, end - row_);
  if (!reason) {
    loaded_begin_ = row_;
    loaded_end_ = end;
    return true;
  }
  if (block_rows_ > chunk_rows_) {
    block_rows_ = chunk_rows_;  // From now on chunk by chunk, so that only the damaged rows are lost.
  } else {
    pass_over(std::min(row_ - row_ % block_rows_ + block_rows_, rows_), *reason, losses);
  }
  return false;
}

void Hdf5Reader::end_at_gap(Losses& losses) {
  losses.add(Damage::cut_packet);
  header_.notes.push_back(fmt::format("{} events are declared, but only the first {} are stored",
                                      content_.events->rows(), rows_));
}

void Hdf5Reader::pass_over(std::uint64_t end, const std::string& reason, Losses& losses) {
  losses.add(Damage::corrupt_packet);
  if (!has_damage_) {
    header_.notes.push_back(
        fmt::format("rows {} to {} cannot be read and are left out: {}", row_, end - 1, reason));
  }
  has_damage_ = true;
  row_ = loaded_begin_ = loaded_end_ = end;
}

}  // namespace

bool looks_like_hdf5(std::span<const std::byte> head) { return has_hdf5_signature(head); }

std::unique_ptr<FormatReader> open_hdf5(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  bytes->peek(kFormatHeadBytes);  // Kept: reading it in the child would move our place in the file, too.
  const auto crash = crash_of([&] { Hdf5Reader(*bytes, options).try_out(); });
  if (crash) {
    throw Error(
        fmt::format("{}: libhdf5 crashes on it ({}): the file is damaged; copy it again, or try h5clear "
                    "or h5repack on a copy",
                    bytes->name(), *crash));
  }
  return std::make_unique<Hdf5Reader>(*bytes, options);
}

}  // namespace esi

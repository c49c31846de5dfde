#include "esi/io/byte_window.hpp"

#include <algorithm>

namespace esi {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 18;

}  // namespace

std::span<const std::byte> ByteWindow::peek(std::size_t bytes) {
  if (available() < bytes) fill(bytes);
  return std::span(buffer_).subspan(begin_, std::min(bytes, available()));
}

std::span<const std::byte> ByteWindow::take(std::size_t bytes) {
  const auto taken = peek(bytes);
  begin_ += taken.size();
  return taken;
}

std::size_t ByteWindow::skip(std::size_t bytes) {
  const std::size_t here = std::min(bytes, available());
  begin_ += here;
  return here < bytes ? here + source_->skip(bytes - here) : here;
}

std::optional<double> ByteWindow::fraction_taken() const {
  const auto bytes = source_->file_bytes();
  if (!bytes || *bytes == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(position()) / static_cast<double>(*bytes));
}

// read_some, not read: a recorder's live pipe is decoded as its packets come.
void ByteWindow::fill(std::size_t bytes) {
  const auto begin = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
  std::copy(begin, begin + static_cast<std::ptrdiff_t>(available()), buffer_.begin());
  end_ = available();
  begin_ = 0;
  while (end_ < bytes) {
    if (end_ == buffer_.size()) {
      buffer_.resize(std::max(kChunkBytes, std::min(bytes, 2 * buffer_.size())));
    }
    const std::size_t read = source_->read_some(std::span(buffer_).subspan(end_));
    if (read == 0) return;
    end_ += read;
  }
}

}  // namespace esi

#include "esi/io/text/buffer.hpp"

#include <cstring>

namespace esi {
namespace {

constexpr std::size_t kShownOfLongLine = 128;
constexpr char kGap = '\x01';

bool may_trickle(const ByteSource& bytes) {
  std::error_code ignored;
  return bytes.is_stdin() || !std::filesystem::is_regular_file(bytes.path(), ignored);
}

}  // namespace

TextBuffer::TextBuffer(std::unique_ptr<ByteSource> bytes)
    : bytes_(std::move(bytes)),
      trickles_(may_trickle(*bytes_)),
      storage_(kCapacity + 2 * kMargin),
      begin_(front()),
      lines_end_(front()),
      end_(front()) {}

void TextBuffer::consume(std::size_t bytes) {
  begin_ += bytes;
  if (begin_ > lines_end_) lines_end_ = begin_;
}

// The buffer is full of one unfinished line: only its beginning is kept.
void TextBuffer::shorten_line() {
  front()[kShownOfLongLine] = kGap;
  end_ = front() + kShownOfLongLine + 1;
}

bool TextBuffer::fill() {
  if (has_ended_) return false;
  const std::size_t kept = remainder().size();
  std::memmove(front(), lines_end_, kept);
  begin_ = lines_end_ = front();
  end_ = begin_ + kept;
  if (kept == kCapacity) shorten_line();

  const std::span<char> room(end_, front() + kCapacity);
  const std::size_t n = trickles_ ? bytes_->read_some(std::as_writable_bytes(room))
                                  : bytes_->read(std::as_writable_bytes(room));
  has_ended_ = n == 0;
  const void* const newline = n == 0 ? nullptr : memrchr(end_, '\n', n);
  end_ += n;
  if (newline != nullptr) lines_end_ = front() + (static_cast<const char*>(newline) - front()) + 1;
  return !has_ended_;
}

}  // namespace esi

#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "esi/io/byte_source.hpp"

namespace esi {

/// A window over a text that moves forward line by line, of fixed size whatever the text's length.
/// Of a line that does not fit, the beginning and the end stay, with a control character between them, so
/// that it can still be shown and skipped but never be taken for numbers.
class TextBuffer {
 public:
  /// Bytes around the text that may be read (not used), so that lines can be loaded in whole words.
  static constexpr std::size_t kMargin = 64;
  static constexpr std::size_t kCapacity = std::size_t{256} << 10;

  explicit TextBuffer(std::unique_ptr<ByteSource> bytes);

  const std::string& name() const { return bytes_->name(); }
  const ByteSource& bytes() const { return *bytes_; }

  /// The whole lines that are here, each with its '\n'.
  std::string_view lines() const { return {begin_, static_cast<std::size_t>(lines_end_ - begin_)}; }
  /// What follows them: the last line, where the text does not end with '\n'. Complete when has_ended().
  std::string_view remainder() const { return {lines_end_, static_cast<std::size_t>(end_ - lines_end_)}; }

  /// Passes over the first `bytes` of lines(), or of remainder() once there are no lines.
  void consume(std::size_t bytes);

  /// Once all lines are consumed: reads on, waiting only until some bytes are there. False at the end of the
  /// text. Moves the text: views of it end here.
  bool fill();
  bool has_ended() const { return has_ended_; }

 private:
  char* front() { return storage_.data() + kMargin; }
  void shorten_line();

  std::unique_ptr<ByteSource> bytes_;
  bool trickles_;  ///< a pipe, from which less may come than is asked for
  bool has_ended_ = false;
  std::vector<char> storage_;
  char* begin_;
  char* lines_end_;
  char* end_;
};

}  // namespace esi

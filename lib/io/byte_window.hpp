#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/io/byte_source.hpp"

namespace esi {

/// A ByteSource read in large pieces and looked at in place: for formats of many small packets.
class ByteWindow {
 public:
  explicit ByteWindow(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}

  const std::string& name() const { return source_->name(); }

  /// The next bytes in one piece, fewer only at the end of the input; valid until the next call.
  /// Memory grows with the bytes that are there, not with what is asked for.
  std::span<const std::byte> peek(std::size_t bytes);

  /// Like peek, and passes over them.
  std::span<const std::byte> take(std::size_t bytes);

  /// Passes over bytes; returns how many there were.
  std::size_t skip(std::size_t bytes);

  /// How many bytes peek gives without waiting for more.
  std::size_t available() const { return end_ - begin_; }

  /// Bytes taken so far: the position that messages give.
  std::size_t position() const { return source_->position() - available(); }

  /// How much of the input is taken, 0 to 1, where its size is known. For progress only.
  std::optional<double> fraction_taken() const;

 private:
  void fill(std::size_t bytes);

  std::unique_ptr<ByteSource> source_;
  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what is read but not yet taken: buffer_[begin_, end_)
};

}  // namespace esi

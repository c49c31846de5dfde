#include "esi/io/writing/lz4_frame.hpp"

#include <fmt/format.h>
#include <lz4frame.h>

#include "esi/core/error.hpp"

namespace esi {

std::vector<std::byte> lz4_frame(std::span<const std::byte> bytes) {
  std::vector<std::byte> frame(LZ4F_compressFrameBound(bytes.size(), nullptr));
  const std::size_t size =
      LZ4F_compressFrame(frame.data(), frame.size(), bytes.data(), bytes.size(), nullptr);
  if (LZ4F_isError(size) != 0) {
    throw Error(fmt::format("LZ4 cannot compress {} bytes ({})", bytes.size(), LZ4F_getErrorName(size)));
  }
  frame.resize(size);
  return frame;
}

}  // namespace esi

#include "esi/io/decompress.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <new>

namespace esi {
namespace {

class StoredBytes final : public Decompressor {
 public:
  void begin(std::span<const std::byte> frame) override { input_ = frame; }

  std::optional<std::size_t> read(std::span<std::byte> target) override {
    const std::size_t bytes = std::min(target.size(), input_.size());
    std::copy_n(input_.begin(), bytes, target.begin());
    input_ = input_.subspan(bytes);
    return bytes;
  }

 private:
  std::span<const std::byte> input_;
};

/// What one call of a library's streaming decoder did.
struct Step {
  std::size_t consumed = 0;
  std::size_t produced = 0;
  bool failed = false;
  bool at_frame_end = false;
};

class StreamDecompressor : public Decompressor {
 public:
  void begin(std::span<const std::byte> frame) override {
    input_ = frame;
    at_frame_end_ = false;
    reset();
  }

  std::optional<std::size_t> read(std::span<std::byte> target) override {
    std::size_t filled = 0;
    while (!at_frame_end_ && filled < target.size()) {
      const Step step = decode(target.subspan(filled), input_);
      if (step.failed) return std::nullopt;
      filled += step.produced;
      input_ = input_.subspan(step.consumed);
      at_frame_end_ = step.at_frame_end;
      const bool starved = step.produced == 0 && step.consumed == 0;
      if (starved && !at_frame_end_) return std::nullopt;
    }
    return filled;
  }

 private:
  virtual void reset() = 0;
  virtual Step decode(std::span<std::byte> target, std::span<const std::byte> input) = 0;

  std::span<const std::byte> input_;
  bool at_frame_end_ = false;
};

class Lz4Decompressor final : public StreamDecompressor {
 public:
  Lz4Decompressor() {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
    context_.reset(context);
  }

 private:
  struct Free {
    void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
  };

  void reset() override { LZ4F_resetDecompressionContext(context_.get()); }

  Step decode(std::span<std::byte> target, std::span<const std::byte> input) override {
    std::size_t produced = target.size();
    std::size_t consumed = input.size();
    const std::size_t hint =
        LZ4F_decompress(context_.get(), target.data(), &produced, input.data(), &consumed, nullptr);
    return {consumed, produced, LZ4F_isError(hint) != 0, hint == 0};
  }

  std::unique_ptr<LZ4F_dctx, Free> context_;
};

class ZstdDecompressor final : public StreamDecompressor {
 public:
  ZstdDecompressor() : context_(ZSTD_createDCtx()) {
    if (!context_) throw std::bad_alloc();
  }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };

  void reset() override { ZSTD_DCtx_reset(context_.get(), ZSTD_reset_session_only); }

  Step decode(std::span<std::byte> target, std::span<const std::byte> input) override {
    ZSTD_outBuffer out{target.data(), target.size(), 0};
    ZSTD_inBuffer in{input.data(), input.size(), 0};
    const std::size_t hint = ZSTD_decompressStream(context_.get(), &out, &in);
    return {in.pos, out.pos, ZSTD_isError(hint) != 0, hint == 0};
  }

  std::unique_ptr<ZSTD_DCtx, Free> context_;
};

}  // namespace

std::unique_ptr<Decompressor> make_decompressor(Codec codec) {
  switch (codec) {
    case Codec::lz4:
      return std::make_unique<Lz4Decompressor>();
    case Codec::zstd:
      return std::make_unique<ZstdDecompressor>();
    case Codec::none:
      break;
  }
  return std::make_unique<StoredBytes>();
}

}  // namespace esi

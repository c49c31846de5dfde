#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "esi/core/error.hpp"
#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"
#include "esi/core/options.hpp"
#include "esi/core/worker_pool.hpp"

namespace esi {

/// How frames are written.
struct SinkOptions {
  bool force = false;
  bool resume = false;
  std::int64_t png_compression = 1;

  void declare(OptionTable& table);
};

/// What a sink must know before the first frame.
struct SinkContext {
  SensorSize size;
  double fps = 0;           ///< nominal rate of a video; 100 where frames are not at a fixed rate
  std::string fingerprint;  ///< of input and options: what --resume compares
  /// Who may encode beside the calling thread, to which the pool belongs.
  std::shared_ptr<WorkerPool> workers = std::make_shared<WorkerPool>(0);
};

/// Whoever read the frames has closed the pipe: not a fault, but nothing more can be done (a tool exits with
/// 141).
class ClosedPipe : public Error {
 public:
  explicit ClosedPipe(const std::string& name) : Error(name + ": closed by its reader") {}
};

/// --resume found the folder complete, made from the same input with the same options. A tool that was given
/// several recordings may count this as done.
class AlreadyComplete : public Error {
 public:
  explicit AlreadyComplete(const std::string& name)
      : Error(
            name + ": is already complete, from the same input with the same options; --force makes it anew",
            Kind::usage) {}
};

/// Takes frames in order. A sink that is destroyed before finish() leaves nothing that claims to be complete.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// Takes a copy of the frame, which must have the context's size and the next index. Throws an Error,
  /// perhaps one of an earlier frame; then only stop() makes sense.
  virtual void write(const Frame& frame) = 0;

  /// All frames are written and checked when this returns; `manifest` (JSON text) is written last. A pipe
  /// takes no manifest, and a video may go without one (empty) as part of something larger.
  virtual void finish(const std::string& manifest) = 0;

  /// Ends early: keeps the frames that are whole, from the first without a gap, and doesn't mark them as
  /// complete. Throws an Error of an earlier frame that was not yet thrown.
  virtual void stop() = 0;
};

/// Throws an Error unless the frame is the one of that index and has that size.
void require_next_frame(const Frame& frame, std::int64_t index, SensorSize size);

/// The extension of a name, in lower case: ".mkv".
std::string media_extension(const std::filesystem::path& path);

/// Whether an output's name stands for a folder: it is one, or its extension is no video's or picture's.
bool means_folder(const std::filesystem::path& target);

/// A video (.mp4, .mkv, .avi); for "-", YUV4MPEG2 on standard output; else a folder of PNG files. Refuses,
/// with a usage Error, other media extensions (.mov, .png), a folder that is not empty and a file that
/// exists, unless options.force, or options.resume for a folder.
std::unique_ptr<FrameSink> open_frame_sink(const std::filesystem::path& target, const SinkOptions& options,
                                           const SinkContext& context);

}  // namespace esi

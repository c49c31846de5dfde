#include "esi/io/output/png_folder_sink.hpp"

#include <algorithm>
#include <exception>
#include <span>

#include "esi/core/error.hpp"
#include "esi/io/output/encode_png.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

/// Bounds the memory that waiting frames take.
constexpr std::size_t kFramesPerWorker = 4;

void write_png(const std::filesystem::path& path, const cv::Mat1b& grey, int level) {
  const std::vector<std::uint8_t> png = encode_png(grey, level);
  write_file(path, std::as_bytes(std::span(png)));
}

}  // namespace

PngFolderSink::PngFolderSink(const std::filesystem::path& folder, const SinkOptions& options,
                             const SinkContext& context)
    : folder_(folder, options, context.fingerprint),
      lists_(folder),
      size_(context.size),
      png_level_(static_cast<int>(options.png_compression)),
      workers_(context.workers) {}

PngFolderSink::~PngFolderSink() {
  // Once the folder's lock is gone, somebody else may write there.
  for (const Pending& pending : pending_) pending.written.wait();
}

void PngFolderSink::write(const Frame& frame) {
  require_no_failure();
  require_next_frame(frame, frames_taken_, size_);
  ++frames_taken_;
  const auto path = folder_.frame_path(frame.index);
  const bool may_be_there = folder_.is_resumed();
  const bool runs_here = workers_->workers() == 0;
  auto task = [path, may_be_there, size = size_, level = png_level_,
               grey = runs_here ? frame.grey : cv::Mat1b(frame.grey.clone())] {
    if (!may_be_there || !is_whole_png(path, size)) write_png(path, grey, level);
  };
  pending_.push_back({{frame.index, frame.t_us, frame.events_since_previous, {}}, workers_->submit(task)});
  while (pending_.size() > kFramesPerWorker * workers_->workers()) settle_oldest();
}

void PngFolderSink::finish(const std::string& manifest) {
  require_no_failure();
  while (!pending_.empty()) settle_oldest();
  if (folder_.is_resumed()) folder_.remove_frames(lists_.size());
  lists_.commit();
  folder_.complete(manifest);
}

void PngFolderSink::stop() {
  std::exception_ptr error;
  while (!pending_.empty()) {
    try {
      settle_oldest();
    } catch (const std::exception&) {
      if (!error) error = std::current_exception();
    }
  }
  keep_only_whole_frames();
  lists_.commit();
  if (error) std::rethrow_exception(error);
}

void PngFolderSink::require_no_failure() const {
  if (has_failed_) throw Error(folder_.path().string() + ": an earlier frame could not be written");
}

/// Once a frame has failed, no later one gets into the lists.
void PngFolderSink::settle_oldest() {
  Pending oldest = std::move(pending_.front());
  pending_.pop_front();
  const bool follows_failure = has_failed_;
  has_failed_ = true;  // unless the next line returns
  workers_->finish(std::move(oldest.written));
  has_failed_ = follows_failure;
  if (!has_failed_) lists_.add(oldest.frame);
}

/// Takes away what workers wrote behind a frame that failed. An interrupted run's frames that go on where the
/// lists end are whole, and stay for the next --resume.
void PngFolderSink::keep_only_whole_frames() {
  std::int64_t end = lists_.size();
  while (is_whole_png(folder_.frame_path(end), size_)) ++end;
  folder_.remove_frames(end);
}

}  // namespace esi

#include "esi/pipeline/ready_method.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_digest.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/memory_limit.hpp"

namespace esi {
namespace {

// Images and encoder; only absurd sizes come near any limit.
constexpr std::uint64_t kFrameBytesPerPixel = 24;
// Times and counts of the steps around it, their images, and where undistorted pixels come from.
constexpr std::uint64_t kStepBytesPerPixel = 40;
// Far more than any published network needs.
constexpr std::size_t kMaxModelBytes = std::size_t{1} << 30;

void refuse_missing_packets(const ReconConfig& config, const MethodContext& context) {
  if (!config.frames.packets || context.header->has_packets) return;
  throw usage_error(fmt::format("{}: the file ({}) is not made of packets; use --fps instead of --packets",
                                context.name, context.header->layout));
}

void refuse_missing_frames(const ReconConfig& config, const MethodContext& context) {
  if (context.header->has_intensity_frames) return;
  if (config.method().frames == FrameUse::required) {
    throw usage_error(
        fmt::format("{}: method '{}' needs intensity frames, and this recording ({}) has none; "
                    "use a method that lives on events alone (see --list-methods)",
                    context.name, config.method().name, context.header->layout));
  }
  if (config.frames.at_frames) {
    throw usage_error(
        fmt::format("{}: this recording ({}) has no intensity frames; use --fps instead of --at-frames",
                    context.name, context.header->layout));
  }
}

void refuse_too_large(const ReconConfig& config, SensorSize size) {
  const auto pixels = static_cast<std::uint64_t>(size.width_px) * static_cast<std::uint64_t>(size.height_px);
  const std::uint64_t bytes_per_pixel = kFrameBytesPerPixel + config.method().state_bytes_per_pixel +
                                        (config.steps.any() ? kStepBytesPerPixel : 0);
  require_memory(bytes_per_pixel * pixels, "a sensor of " + to_string(size));
}

StepSurroundings checked_surroundings(const ReconConfig& config, const MethodContext& context) {
  config.steps.check();
  refuse_missing_packets(config, context);
  refuse_missing_frames(config, context);
  refuse_too_large(config, context.size());
  return surroundings_of(config.steps, context.recording, context.read, context.sensor, context.region);
}

}  // namespace

ReadyMethod::ReadyMethod(const ReconConfig& config, const MethodContext& context)
    : steps_(config.steps),
      surroundings_(checked_surroundings(config, context)),
      removed_(std::make_unique<RemovedEvents>()),
      files_(std::make_unique<nlohmann::json>(nlohmann::json::object())) {
  auto method = config.method_config().create(context.size(), [this](const std::string& path) {
    std::string content = read_text_file(path, kMaxModelBytes);
    (*files_)[path] = crc32_of(content);
    return content;
  });
  reconstructor_ = with_steps(std::move(method), steps_.steps, surroundings_, *removed_);
}

ReadyMethod::~ReadyMethod() = default;

nlohmann::json ReadyMethod::steps_json() const { return esi::steps_json(steps_, surroundings_, *removed_); }

}  // namespace esi

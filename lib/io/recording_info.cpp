#include "esi/io/recording_info.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace esi {
namespace {

template <class Reason>
nlohmann::json counts_json(const Losses& losses) {
  nlohmann::json counts = nlohmann::json::object();
  for (int i = 0; i < static_cast<int>(Reason::count_); ++i) {
    const auto reason = static_cast<Reason>(i);
    counts[std::string(name_of(reason))] = losses.of(reason);
  }
  return counts;
}

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

std::string rate_text(const EventDigest& digest) {
  if (digest.duration_us() == 0) return "";
  const double rate_mhz = static_cast<double>(digest.events()) / static_cast<double>(digest.duration_us());
  return fmt::format(" ({:.3f} Mev/s)", rate_mhz);
}

}  // namespace

std::optional<std::int64_t> RecordingInfo::t_first_us() const {
  const auto on_clock = digest.t_first_us();
  return on_clock ? std::optional(*on_clock + time_zero_us) : std::nullopt;
}

RecordingInfo inspect(EventSource& source, const std::function<void(const Packet&)>& look) {
  RecordingInfo info;
  Packet packet;
  while (source.next(packet)) {
    info.digest.add(packet.events);
    info.intensity_frames += static_cast<std::int64_t>(packet.frames.size());
    if (look) look(packet);
  }
  info.header = source.header();
  info.sensor = source.sensor_size();
  info.time_zero_us = source.time_zero_us();
  info.losses = source.losses();
  return info;
}

nlohmann::json dropped_json(const Losses& losses) { return counts_json<Drop>(losses); }
nlohmann::json damaged_json(const Losses& losses) { return counts_json<Damage>(losses); }

nlohmann::json to_json(const RecordingInfo& info) {
  const EventDigest& digest = info.digest;
  const bool has_events = digest.events() > 0;
  return {
      {"format", info.header.format},
      {"layout", info.header.layout},
      {"width", info.sensor ? nlohmann::json(info.sensor->width_px) : nlohmann::json()},
      {"height", info.sensor ? nlohmann::json(info.sensor->height_px) : nlohmann::json()},
      {"max_x", has_events ? nlohmann::json(digest.max_x()) : nlohmann::json()},
      {"max_y", has_events ? nlohmann::json(digest.max_y()) : nlohmann::json()},
      {"events", digest.events()},
      {"on", digest.on()},
      {"t_first_us", or_null(info.t_first_us())},
      {"duration_us", digest.duration_us()},
      {"time_zero_us", info.time_zero_us},
      {"sum_x", digest.sum_x()},
      {"sum_y", digest.sum_y()},
      {"crc32", digest.crc32()},
      {"frames", info.intensity_frames},
      {"dropped", dropped_json(info.losses)},
      {"damaged", damaged_json(info.losses)},
      {"notes", info.header.notes},
  };
}

std::string to_text(const RecordingInfo& info) {
  const EventDigest& digest = info.digest;
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<12} {}\n", name, value);
  };
  line("format", fmt::format("{} ({})", info.header.format, info.header.layout));
  line("sensor", info.sensor ? to_string(*info.sensor) : "not in the file");
  line("events", fmt::format("{}{}", digest.events(), rate_text(digest)));
  if (digest.events() > 0) {
    const double on_share = static_cast<double>(digest.on()) / static_cast<double>(digest.events());
    line("ON", fmt::format("{} ({:.1f} %)", digest.on(), 100.0 * on_share));
    line("largest x, y", fmt::format("{}, {}", digest.max_x(), digest.max_y()));
    line("first event", fmt::format("{} us", *info.t_first_us()));
    line("lasts", fmt::format("{:.6f} s", static_cast<double>(digest.duration_us()) * 1e-6));
  }
  line("frames", fmt::format("{}", info.intensity_frames));
  line("crc32", digest.crc32());
  line("lost", info.losses.any() ? info.losses.text() : "nothing");
  for (const std::string& note : info.header.notes) line("note", note);
  return text;
}

}  // namespace esi

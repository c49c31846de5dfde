#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "esi/io/event_digest.hpp"
#include "esi/io/format_reader.hpp"
#include "esi/io/losses.hpp"

namespace esi {

/// What a run was and did: the content of run.json, whose presence says that the folder is complete.
struct RunManifest {
  std::string tool;
  std::string recording;  ///< path as given
  RecordingHeader header;
  SensorSize size;
  EventDigest digest;  ///< of the events used
  std::int64_t time_zero_us = 0;
  Losses losses;
  std::int64_t frames = 0;
  std::int64_t intensity_frames = 0;
  nlohmann::json steps;     ///< what the steps around the method found and removed; no losses
  nlohmann::json files;     ///< that the method read: path and CRC-32
  nlohmann::json config;    ///< all effective parameters
  std::string fingerprint;  ///< of recording and parameters

  /// What may differ between two runs of the same command.
  struct Run {
    int threads = 1;
    double wall_s = 0;
  };
  Run run;
};

/// The block "run", with host and date added: all that may differ between two runs of the same command.
nlohmann::json to_json(const RunManifest::Run& run);

/// As JSON text, with host, date and run time in the block "run" only.
std::string to_text(const RunManifest& manifest);

}  // namespace esi

#include "esi/io/aedat2/header.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/aedat2/address.hpp"
#include "esi/io/aedat_line.hpp"

namespace esi {
namespace {

// Addresses of a DAVIS are below 2^16 only on a few pixels at a corner.
constexpr std::size_t kProbedRecords = 1024;

// What the bits of x and y can hold.
constexpr SensorSize kLargestDvs128{128, 128};
constexpr SensorSize kLargestDavis{1024, 512};

void check_version(const std::string& line, const std::string& name) {
  if (line == "#!AER-DAT2.0") return;
  throw Error(
      fmt::format("{}: it is AEDAT {}, and of these old versions only 2.0 is read; open it in jAER and save "
                  "it again",
                  name, line.substr(kAedat2Magic.size() - 2, 8)));
}

/// The chip that the header names; empty where it names none.
std::string take_chip_name(ByteWindow& bytes) {
  const auto version = take_aedat_line(bytes);
  if (!version) {
    throw Error(
        fmt::format("{}: the first line does not end in CR LF; if the file was transferred as text, copy it "
                    "again as binary",
                    bytes.name()));
  }
  check_version(*version, bytes.name());
  std::string chip;
  while (const auto line = take_aedat_line(bytes)) {
    if (const auto value = value_in_aedat_line(*line, "# AEChip:")) chip = *value;
  }
  return chip;
}

SensorSize size_of(const CameraChip& chip, const ReadOptions& options) {
  const SensorSize size = options.sensor_size().value_or(chip.size);
  const SensorSize largest = chip.is_davis ? kLargestDavis : kLargestDvs128;
  if (size.width_px > largest.width_px || size.height_px > largest.height_px) {
    throw usage_error(fmt::format("size {}: addresses as those of a {} have room for {} only",
                                  to_string(size), chip.name, to_string(largest)));
  }
  return size;
}

/// "...; give --chip": how a chip that is not known can be read all the same.
std::string chip_advice() {
  return fmt::format(
      "give with --chip one whose addresses it shares ({}), and with --size its size if that is another",
      camera_chip_names());
}

Aedat2Camera assumed_camera(ByteWindow& bytes) {
  if (!are_dvs128_records(bytes.peek(kProbedRecords * kAedat2RecordBytes))) {
    throw usage_error(
        fmt::format("{}: the header names no chip, and the addresses are not those of a DVS128; {}",
                    bytes.name(), chip_advice()));
  }
  const CameraChip& chip = require_camera_chip("DVS128");
  return {chip, chip.size, {"The header names no chip: a DVS128 is assumed, which the addresses fit."}};
}

}  // namespace

Aedat2Camera read_aedat2_header(ByteWindow& bytes, const ReadOptions& options) {
  const std::string name = take_chip_name(bytes);
  if (bytes.peek(1).empty()) {
    throw Error(fmt::format("{}: the file ends with its header, at byte {}: it holds no events", bytes.name(),
                            bytes.position()));
  }
  if (!options.chip.empty()) {
    const CameraChip& chip = require_camera_chip(options.chip);
    return {chip, size_of(chip, options), {}};
  }
  if (name.empty()) return assumed_camera(bytes);
  const CameraChip* const chip = find_camera_chip(name);
  if (chip == nullptr) {
    throw usage_error(fmt::format("{}: the header's chip, '{}', is not known; {}", bytes.name(),
                                  name.substr(0, 128), chip_advice()));
  }
  return {*chip, chip->size, {}};
}

}  // namespace esi

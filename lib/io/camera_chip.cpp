#include "esi/io/camera_chip.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr CameraChip kChips[] = {
    {"DVS128", {128, 128}, false},  {"DAVIS128", {128, 128}, true}, {"DAVIS208", {208, 192}, true},
    {"DAVIS240", {240, 180}, true}, {"DAVIS346", {346, 260}, true}, {"DAVIS640", {640, 480}, true},
};

constexpr std::string_view kDigits = "0123456789";

// Not std::toupper, which goes by the locale.
std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

/// Behind the family's name stands the variant: DAVIS240C, Davis346blue. The heterogeneous DAVIS640het is
/// none: its events have a quarter of the pixels.
bool is_variant(std::string_view name, std::string_view family) {
  if (!name.starts_with(family)) return false;
  const std::string_view variant = name.substr(family.size());
  return !variant.starts_with("HET") && variant.find_first_of(kDigits) != 0;
}

}  // namespace

const CameraChip* find_camera_chip(std::string_view described) {
  const std::string name = upper(described.substr(described.rfind('.') + 1));
  const auto* const chip = std::find_if(std::begin(kChips), std::end(kChips),
                                        [&](const CameraChip& c) { return is_variant(name, c.name); });
  return chip == std::end(kChips) ? nullptr : chip;
}

const CameraChip& require_camera_chip(std::string_view name) {
  const auto* const chip = std::find_if(std::begin(kChips), std::end(kChips),
                                        [&](const CameraChip& c) { return upper(name) == c.name; });
  if (chip == std::end(kChips)) {
    throw usage_error(fmt::format("chip '{}': give one of {}", name, camera_chip_names()));
  }
  return *chip;
}

std::string camera_chip_names() {
  std::string names;
  for (const CameraChip& chip : kChips) names += fmt::format("{}{}", names.empty() ? "" : ", ", chip.name);
  return names;
}

}  // namespace esi

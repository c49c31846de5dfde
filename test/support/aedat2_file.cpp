#include "support/aedat2_file.hpp"

namespace esi::test {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

std::uint32_t at_pixel(int x, int y) {
  return static_cast<std::uint32_t>(x) << 12 | static_cast<std::uint32_t>(y) << 22;
}

}  // namespace

std::string aedat2_header(std::string_view chip) {
  std::string header =
      "#!AER-DAT2.0\r\n"
      "# This is a raw AE data file - do not edit\r\n"
      "# Data format is int32 address, int32 timestamp (8 bytes total), repeated for each event\r\n"
      "# Timestamps tick is 1 us\r\n";
  if (!chip.empty()) header.append("# AEChip: ").append(chip).append("\r\n");
  return header;
}

std::string aedat2_record(std::uint32_t address, std::uint32_t t_us) {
  return big_endian(address) + big_endian(t_us);
}

std::uint32_t dvs128_address(int x, int y, bool on) {
  return static_cast<std::uint32_t>(y) << 8 | static_cast<std::uint32_t>(x) << 1 | (on ? 0U : 1U);
}

std::uint32_t davis_address(int x, int y, bool on) { return at_pixel(x, y) | (on ? 0x800U : 0U); }

std::uint32_t davis_reset_read(int x, int y, int adc) {
  return 0x80000000U | at_pixel(x, y) | static_cast<std::uint32_t>(adc);
}

std::uint32_t davis_signal_read(int x, int y, int adc) { return davis_reset_read(x, y, adc) | 0x400U; }

std::string davis_imu_sample(std::uint32_t t_us) {
  std::string words;
  for (std::uint32_t code = 0; code < 7; ++code) {
    words += aedat2_record(0x80000C00U | code << 28 | (1000U + code) << 12, t_us);
  }
  return words;
}

std::string aedat2_recording(std::span<const Event> events) {
  std::string bytes = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");
  for (const Event& event : events) {
    bytes += aedat2_record(davis_address(239 - event.x, 179 - event.y, event.on),
                           static_cast<std::uint32_t>(event.t_us));
  }
  return bytes;
}

}  // namespace esi::test

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "esi/core/event.hpp"

namespace esi::test {

/// "#!AER-DAT2.0" and the lines that jAER writes; `chip` as behind "# AEChip: ", or empty: without that line.
std::string aedat2_header(std::string_view chip);

/// Address and time, both big-endian.
std::string aedat2_record(std::uint32_t address, std::uint32_t t_us);

/// Addresses as the chips send them: x from the right and y from the bottom, but for the readings of a
/// DAVIS's intensity frames, whose x is from the left.
std::uint32_t dvs128_address(int x, int y, bool on);
std::uint32_t davis_address(int x, int y, bool on);
std::uint32_t davis_reset_read(int x, int y, int adc);
std::uint32_t davis_signal_read(int x, int y, int adc);
/// Seven words that follow one another, all at one time: a sample of the IMU.
std::string davis_imu_sample(std::uint32_t t_us);

/// A recording of a DAVIS240C: sorted events within 240x180, times below 2^32 us.
std::string aedat2_recording(std::span<const Event> events);

}  // namespace esi::test

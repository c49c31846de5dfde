#include "esi/io/read_options.hpp"

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/io/camera_chip.hpp"

namespace esi {
namespace {

void check_size(const std::string& text) {
  if (!text.empty()) parse_sensor_size(text);
}

void check_chip(const std::string& text) {
  if (!text.empty()) require_camera_chip(text);
}

void check_columns(const std::string& text) {
  std::string sorted = text;
  std::sort(sorted.begin(), sorted.end());
  if (!text.empty() && sorted != "ptxy") {
    throw usage_error("columns '" + text + "': write each of t, x, y, p once, such as txyp or xypt");
  }
}

}  // namespace

void ReadOptions::declare(OptionTable& table) {
  table.text("size", size, "sensor size WIDTHxHEIGHT in px, where the file does not have it", check_size);
  table.text("chip", chip,
             "the camera's chip, where an AEDAT file does not name one that is known: " + camera_chip_names(),
             check_chip);
  table.text("columns", columns, "order of a text file's columns, such as txyp or xypt", check_columns);
  table.text("stream", stream, "which event stream, where the file has several");
  table.choice("time_unit", time_unit, {"auto", "s", "ms", "us", "ns"}, "unit of the times in a text file");
  table.choice("time_zero", time_zero, {"auto", "file", "first-event"},
               "zero of the clock; auto: the file's own, if the recording starts within an hour of it");
  table.choice("polarity", polarity, {"auto", "0/1", "-1/1", "1/2"}, "OFF and ON in a text file");
  table.integer("jitter_us", jitter_us, {0, 1000000}, "us",
                "events up to this much out of order are sorted (and counted)");
  table.integer("max_backward_us", max_backward_us, {0, 3600000000}, "us",
                "events up to this much out of order are left out (and counted); more is an error");
  table.real("max_unreadable", max_unreadable, {0.0, 1.0}, "",
             "share of a text file's lines that may be unreadable");
  table.real("max_outside", max_outside, {0.0, 1.0}, "",
             "share of the events that may lie outside the sensor");
  table.toggle("strict", strict, "fail on damaged or out-of-range input instead of leaving it out");
}

std::optional<SensorSize> ReadOptions::sensor_size() const {
  if (size.empty()) return std::nullopt;
  return parse_sensor_size(size);
}

}  // namespace esi

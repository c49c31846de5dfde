#include "esi/sweep/sweep_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Of one axis; more is a slip of the pen.
constexpr double kMostValues = 10'000;
constexpr const char* kForms = "give a list 0.5,1,2, a range FIRST:LAST:STEP or log:FIRST:LAST:COUNT";

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(std::string_view option, std::string_view values, const std::string& why) {
  throw usage_error(fmt::format("grid {}: '{}' {}; {}", option, values, why, kForms));
}

std::vector<double> numbers_of(std::string_view option, std::string_view values,
                               const std::vector<std::string>& parts) {
  std::vector<double> numbers;
  for (const std::string& part : parts) {
    const auto number = finite_number(part);
    if (!number) refuse(option, values, fmt::format("is no range, since '{}' is no number", part));
    numbers.push_back(*number);
  }
  return numbers;
}

void refuse_too_many(std::string_view option, std::string_view values, double count) {
  if (count > kMostValues) {
    refuse(option, values, fmt::format("has {:.0f} values, more than {:.0f}", count, kMostValues));
  }
}

std::vector<std::string> range_values(std::string_view option, std::string_view values, double first,
                                      double last, double step) {
  if (!(step > 0.0) || last < first)
    refuse(option, values, "has no values: it must ascend by a step above 0");
  const double count = std::floor((last - first) / step + 1e-6) + 1.0;
  refuse_too_many(option, values, count);
  std::vector<std::string> texts;
  for (double i = 0.0; i < count; ++i) texts.push_back(fmt::format("{:.12g}", first + i * step));
  return texts;
}

std::vector<std::string> log_values(std::string_view option, std::string_view values, double first,
                                    double last, double count) {
  if (!(first > 0.0) || !(last > 0.0)) refuse(option, values, "has an end that is not above 0");
  if (count < 1.0 || count != std::floor(count)) refuse(option, values, "needs a whole number of values");
  refuse_too_many(option, values, count);
  std::vector<std::string> texts;
  for (double i = 0.0; i < count; ++i) {
    const double share = count > 1.0 ? i / (count - 1.0) : 0.0;
    texts.push_back(fmt::format("{:.6g}", first * std::pow(last / first, share)));
  }
  return texts;
}

std::string text_of(const nlohmann::json& value, const std::string& name) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "none";
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (value.is_boolean() || value.is_number()) return value.dump();
  throw usage_error(fmt::format("grid {}: {} is no value of an option", name, value.dump()));
}

}  // namespace

AskedAxis parse_axis(std::string_view name, std::string_view values) {
  AskedAxis axis{std::string(name), {}, false};
  const std::vector<std::string> parts = split(values, ':');
  if (parts.front() == "log") {
    const auto numbers = numbers_of(name, values, {parts.begin() + 1, parts.end()});
    if (numbers.size() != 3) refuse(name, values, "is no log range");
    axis.values = log_values(name, values, numbers[0], numbers[1], numbers[2]);
    axis.is_logarithmic = true;
  } else if (parts.size() > 1) {
    const auto numbers = numbers_of(name, values, parts);
    if (numbers.size() != 3) refuse(name, values, "is no range");
    axis.values = range_values(name, values, numbers[0], numbers[1], numbers[2]);
  } else {
    axis.values = split(values, ',');
  }
  return axis;
}

AskedAxis parse_axis(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    throw usage_error(fmt::format("--grid {}: give OPTION=VALUES, such as tau_s=0.5,1,2", assignment));
  }
  return parse_axis(assignment.substr(0, equals), assignment.substr(equals + 1));
}

AskedAxis parse_axis(const std::string& name, const nlohmann::json& values) {
  if (values.is_string()) return parse_axis(std::string_view(name), values.get_ref<const std::string&>());
  if (!values.is_array() || values.empty()) throw usage_error(fmt::format("grid {}: {}", name, kForms));
  AskedAxis axis{name, {}, false};
  for (const auto& value : values) axis.values.push_back(text_of(value, name));
  return axis;
}

SweepAxis checked_axis(const AskedAxis& asked, VariableOption& option) {
  SweepAxis axis{option.name(), option.unit(), {}, {}, asked.is_logarithmic};
  for (const std::string& value : asked.values) {
    option.set_text(value);
    if (std::find(axis.values.begin(), axis.values.end(), option.text()) != axis.values.end()) {
      throw usage_error(fmt::format("grid {}: {} is there twice", asked.option, option.text()));
    }
    axis.values.push_back(option.text());
    if (const nlohmann::json json = option.json(); json.is_number()) {
      axis.numbers.push_back(json.get<double>());
    }
  }
  if (axis.numbers.size() != axis.values.size()) axis.numbers.clear();
  return axis;
}

}  // namespace esi

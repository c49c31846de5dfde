#include "esi/core/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "esi/core/error.hpp"

namespace esi {
namespace {

using Json = nlohmann::json;

// One function per kind of value and per question; std::visit picks it.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

template <class T>
std::optional<T> number_from(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

template <class T>
bool is_within(T value, Bounds<T> bounds) {
  return value >= bounds.min && value <= bounds.max;  // false for NaN
}

std::string joined(std::span<const std::string> names, std::string_view separator) {
  return fmt::format("{}", fmt::join(names, separator));
}

template <class T>
std::string range_text(Bounds<T> bounds, const std::string& unit) {
  return fmt::format("{} to {}{}{}", bounds.min, bounds.max, unit.empty() ? "" : " ", unit);
}

[[noreturn]] void refuse(const Option& option, const std::string& given) {
  const std::string domain = option.domain();
  throw usage_error(fmt::format("option {}: {} is not possible, give {}", option.name(), given,
                                domain.empty() ? option.help() : domain));
}

template <class T>
void assign(const Option& option, T& target, std::optional<T> value, Bounds<T> bounds,
            const std::string& given) {
  if (!value || !is_within(*value, bounds)) refuse(option, given);
  target = *value;
}

void assign_choice(const Option& option, const Option::Choice& choice, std::string_view name) {
  const auto found = std::find(choice.names.begin(), choice.names.end(), name);
  if (found == choice.names.end()) refuse(option, fmt::format("'{}'", name));
  choice.set(static_cast<std::size_t>(found - choice.names.begin()));
}

void assign_text(const Option::Text& text, std::string value) {
  if (text.check) text.check(value);
  *text.value = std::move(value);
}

std::optional<bool> switch_from(std::string_view text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  return std::nullopt;
}

}  // namespace

std::string Option::domain() const {
  return std::visit(Overloaded{
                        [](bool*) { return std::string("true | false"); },
                        [this](const Real& real) { return range_text(real.bounds, unit_); },
                        [this](const OptionalReal& real) { return range_text(real.bounds, unit_); },
                        [this](const Integer& integer) { return range_text(integer.bounds, unit_); },
                        [](const Text&) { return std::string(); },
                        [](const Choice& choice) { return joined(choice.names, " | "); },
                    },
                    value_);
}

void Option::set_text(std::string_view text) {
  const std::string given = fmt::format("'{}'", text);
  std::visit(Overloaded{
                 [&](bool* value) {
                   const auto state = switch_from(text);
                   if (!state) refuse(*this, given);
                   *value = *state;
                 },
                 [&](const Real& real) {
                   assign(*this, *real.value, number_from<double>(text), real.bounds, given);
                 },
                 [&](const OptionalReal& real) {
                   double value = 0;
                   if (text == "none") return real.value->reset();
                   assign(*this, value, number_from<double>(text), real.bounds, given);
                   *real.value = value;
                 },
                 [&](const Integer& integer) {
                   assign(*this, *integer.value, number_from<std::int64_t>(text), integer.bounds, given);
                 },
                 [&](const Text& entry) { assign_text(entry, std::string(text)); },
                 [&](const Choice& choice) { assign_choice(*this, choice, text); },
             },
             value_);
}

void Option::set_json(const Json& value) {
  const std::string given = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  const auto expect = [&](bool right_type) {
    if (!right_type) refuse(*this, given);
  };
  std::visit(Overloaded{
                 [&](bool* target) {
                   expect(value.is_boolean());
                   *target = value.get<bool>();
                 },
                 [&](const Real& real) {
                   expect(value.is_number());
                   assign(*this, *real.value, std::optional(value.get<double>()), real.bounds, given);
                 },
                 [&](const OptionalReal& real) {
                   double number = 0;
                   if (value.is_null()) return real.value->reset();
                   expect(value.is_number());
                   assign(*this, number, std::optional(value.get<double>()), real.bounds, given);
                   *real.value = number;
                 },
                 [&](const Integer& integer) {
                   expect(value.is_number_integer() &&
                          !(value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX));
                   assign(*this, *integer.value, std::optional(value.get<std::int64_t>()), integer.bounds,
                          given);
                 },
                 [&](const Text& entry) {
                   expect(value.is_string());
                   assign_text(entry, value.get<std::string>());
                 },
                 [&](const Choice& choice) {
                   expect(value.is_string());
                   assign_choice(*this, choice, value.get<std::string>());
                 },
             },
             value_);
}

Json Option::json() const {
  return std::visit(
      Overloaded{
          [](const bool* value) -> Json { return *value; },
          [](const Real& real) -> Json { return *real.value; },
          [](const OptionalReal& real) { return real.value->has_value() ? Json(**real.value) : Json(); },
          [](const Integer& integer) -> Json { return *integer.value; },
          [](const Text& text) -> Json { return *text.value; },
          [](const Choice& choice) -> Json { return choice.names.at(choice.get()); },
      },
      value_);
}

std::string Option::text() const {
  const Json value = json();
  if (value.is_null()) return "none";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void OptionTable::toggle(std::string name, bool& value, std::string help) {
  options_.emplace_back(std::move(name), &value, "", std::move(help));
}

void OptionTable::real(std::string name, double& value, Bounds<double> bounds, std::string unit,
                       std::string help) {
  options_.emplace_back(std::move(name), Option::Real{&value, bounds}, std::move(unit), std::move(help));
}

void OptionTable::optional_real(std::string name, std::optional<double>& value, Bounds<double> bounds,
                                std::string unit, std::string help) {
  options_.emplace_back(std::move(name), Option::OptionalReal{&value, bounds}, std::move(unit),
                        std::move(help));
}

void OptionTable::integer(std::string name, std::int64_t& value, Bounds<std::int64_t> bounds,
                          std::string unit, std::string help) {
  options_.emplace_back(std::move(name), Option::Integer{&value, bounds}, std::move(unit), std::move(help));
}

void OptionTable::text(std::string name, std::string& value, std::string help,
                       std::function<void(const std::string&)> check) {
  options_.emplace_back(std::move(name), Option::Text{&value, std::move(check)}, "", std::move(help));
}

Option* OptionTable::find(std::string_view name) {
  const auto found =
      std::find_if(options_.begin(), options_.end(), [&](const Option& o) { return o.name() == name; });
  return found == options_.end() ? nullptr : &*found;
}

Option& OptionTable::at(std::string_view name) {
  if (Option* const option = find(name)) return *option;
  std::vector<std::string> names;
  for (const Option& option : options_) names.push_back(option.name());
  throw usage_error(
      fmt::format("there is no option '{}'; did you mean '{}'?", name, nearest_name(name, names)));
}

void OptionTable::set_json(const Json& object) {
  if (!object.is_object()) throw usage_error("options must be a JSON object of names and values");
  for (const auto& [key, value] : object.items()) at(key).set_json(value);
}

void OptionTable::set_assignment(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw usage_error(fmt::format("'{}': write key=value", assignment));
  }
  at(assignment.substr(0, equals)).set_text(assignment.substr(equals + 1));
}

Json OptionTable::json() const {
  Json object = Json::object();
  for (const Option& option : options_) object[option.name()] = option.json();
  return object;
}

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  // Levenshtein distance, one row at a time.
  const auto distance = [word](const std::string& candidate) {
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = std::exchange(row[0], i + 1);
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const std::size_t changed = diagonal + (word[i] == candidate[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
      }
    }
    return row.back();
  };
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return nearest == candidates.end() ? std::string() : *nearest;
}

}  // namespace esi

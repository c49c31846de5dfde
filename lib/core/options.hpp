#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace esi {

/// Inclusive bounds of a number.
template <class T>
struct Bounds {
  T min;
  T max;
};

/// One declared option: name, unit, bounds, help, and the field where its value lives.
/// JSON, --set, command-line flags, --help, sweep axes and the record of what ran all come from this.
class Option {
 public:
  struct Choice {
    std::vector<std::string> names;
    std::function<std::size_t()> get;
    std::function<void(std::size_t)> set;
  };
  struct Real {
    double* value;
    Bounds<double> bounds;
  };
  struct OptionalReal {
    std::optional<double>* value;  ///< JSON null and the text "none" stand for "not set"
    Bounds<double> bounds;
  };
  struct Integer {
    std::int64_t* value;
    Bounds<std::int64_t> bounds;
  };
  struct Text {
    std::string* value;
    std::function<void(const std::string&)> check;  ///< throws a usage Error on a bad value; may be empty
  };
  using Value = std::variant<bool*, Real, OptionalReal, Integer, Text, Choice>;

  Option(std::string name, Value value, std::string unit, std::string help)
      : name_(std::move(name)), unit_(std::move(unit)), help_(std::move(help)), value_(std::move(value)) {}

  const std::string& name() const { return name_; }  ///< in the form of JSON keys: time_zero
  const std::string& unit() const { return unit_; }
  const std::string& help() const { return help_; }
  bool is_switch() const { return std::holds_alternative<bool*>(value_); }

  /// "0.001 to 1000 s" or "polynomial | power | none"; empty for free text and switches.
  std::string domain() const;

  /// Takes a value as typed on a command line. Throws a usage Error that gives the domain.
  void set_text(std::string_view text);
  /// Takes a value of the right JSON type. Throws a usage Error that gives the domain.
  void set_json(const nlohmann::json& value);

  nlohmann::json json() const;
  std::string text() const;

 private:
  std::string name_, unit_, help_;
  Value value_;
};

/// The declared options of one struct. It holds pointers into that struct, which must outlive it.
class OptionTable {
 public:
  void toggle(std::string name, bool& value, std::string help);
  void real(std::string name, double& value, Bounds<double> bounds, std::string unit, std::string help);
  void optional_real(std::string name, std::optional<double>& value, Bounds<double> bounds, std::string unit,
                     std::string help);
  void integer(std::string name, std::int64_t& value, Bounds<std::int64_t> bounds, std::string unit,
               std::string help);
  void text(std::string name, std::string& value, std::string help,
            std::function<void(const std::string&)> check = {});
  /// `names[i]` is the text of the enumerator with value i.
  template <class Enum>
  void choice(std::string name, Enum& value, std::vector<std::string> names, std::string help) {
    Option::Choice entry{std::move(names), [&value] { return static_cast<std::size_t>(value); },
                         [&value](std::size_t i) { value = static_cast<Enum>(i); }};
    options_.emplace_back(std::move(name), std::move(entry), "", std::move(help));
  }

  std::span<Option> options() { return options_; }
  std::span<const Option> options() const { return options_; }

  /// Throws a usage Error that names the nearest known option.
  Option& at(std::string_view name);
  /// nullptr when there is none of that name.
  Option* find(std::string_view name);

  /// Sets every key of a JSON object.
  void set_json(const nlohmann::json& object);
  /// "key=value"
  void set_assignment(std::string_view assignment);
  nlohmann::json json() const;

 private:
  std::vector<Option> options_;
};

/// Options that belong together, for flags and --help.
struct OptionGroup {
  std::string title;
  OptionTable table;
};

/// The table of a struct that has `void declare(OptionTable&)`.
template <class Options>
OptionTable table_of(Options& options) {
  OptionTable table;
  options.declare(table);
  return table;
}

/// The candidate with the smallest edit distance to `word`; empty when there are no candidates.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

}  // namespace esi

#include "esi/sweep/variable_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Of the options about frames those that say when they are due; the rest says which part is used, and is
/// shared by cells that are evaluated together.
constexpr std::array<std::string_view, 2> kSchedules{"fps", "every_events"};

struct Coupling {
  std::string_view name, first, second;
  double factor;  ///< of the second
};
constexpr std::array<Coupling, 2> kCouplings{Coupling{"clamp", "e_max", "e_min", -1.0},
                                             Coupling{"c", "c_on", "c_off", 1.0}};

void add_couplings(std::vector<VariableOption>& all, OptionTable& method) {
  for (const Coupling& coupling : kCouplings) {
    const Option* const first = method.find(coupling.first);
    const Option* const second = method.find(coupling.second);
    if (first == nullptr || second == nullptr) continue;
    all.emplace_back(std::string(coupling.name), std::vector<Option>{*first, *second},
                     std::vector<double>{1.0, coupling.factor});
  }
}

}  // namespace

VariableOption::VariableOption(Option option)
    : name_(option.name()), options_{std::move(option)}, factors_{1.0} {}

VariableOption::VariableOption(std::string name, std::vector<Option> options, std::vector<double> factors)
    : name_(std::move(name)), options_(std::move(options)), factors_(std::move(factors)) {}

void VariableOption::set_text(std::string_view text) {
  options_.front().set_text(text);
  if (options_.size() == 1) return;
  const double value = options_.front().json().get<double>();
  for (std::size_t i = 1; i < options_.size(); ++i) {
    options_[i].set_text(fmt::format("{}", value * factors_[i]));
  }
}

std::vector<std::string> VariableOption::option_names() const {
  std::vector<std::string> names;
  names.reserve(options_.size());
  for (const Option& option : options_) names.push_back(option.name());
  return names;
}

nlohmann::json VariableOption::json() const { return options_.front().json(); }

std::vector<VariableOption> variable_options(ReconConfig& config) {
  std::vector<VariableOption> all;
  OptionTable steps = table_of(config.steps), frames = table_of(config.frames);
  for (const Option& option : config.method_options().options()) all.emplace_back(option);
  for (const Option& option : steps.options()) all.emplace_back(option);
  for (const Option& option : frames.options()) {
    const bool is_schedule =
        std::find(kSchedules.begin(), kSchedules.end(), option.name()) != kSchedules.end();
    if (is_schedule) all.emplace_back(option);
  }
  add_couplings(all, config.method_options());
  return all;
}

VariableOption& option_named(std::vector<VariableOption>& options, const std::string& name) {
  const auto has_name = [&](const VariableOption& option) { return option.name() == name; };
  const auto found = std::find_if(options.begin(), options.end(), has_name);
  if (found != options.end()) return *found;
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const VariableOption& option : options) names.push_back(option.name());
  throw usage_error(fmt::format("grid {}: there is no such option to sweep; did you mean '{}'?", name,
                                nearest_name(name, names)));
}

}  // namespace esi

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/pipeline/recon_config.hpp"

namespace esi {

/// What a sweep can vary: an option, or several that go together under a name of their own, such as `clamp`
/// for e_max and -e_min. It holds pointers into the config, which must outlive it.
class VariableOption {
 public:
  explicit VariableOption(Option option);
  /// Each option gets the value times its factor; the first one's factor is 1.
  VariableOption(std::string name, std::vector<Option> options, std::vector<double> factors);

  const std::string& name() const { return name_; }
  /// One, or those that go together.
  std::vector<std::string> option_names() const;
  const std::string& unit() const { return options_.front().unit(); }

  /// Throws a usage Error that gives the domain.
  void set_text(std::string_view text);
  /// Of the first option.
  std::string text() const { return options_.front().text(); }
  nlohmann::json json() const;

 private:
  std::string name_;
  std::vector<Option> options_;
  std::vector<double> factors_;
};

/// The options of the method, those of the steps around it, when frames are due, and last those that go
/// together, as far as the method has them.
std::vector<VariableOption> variable_options(ReconConfig& config);

/// The one of that name. Throws a usage Error that names the nearest.
VariableOption& option_named(std::vector<VariableOption>& options, const std::string& name);

}  // namespace esi

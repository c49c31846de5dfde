#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "esi/sweep/variable_option.hpp"

namespace esi {

/// One option and the values that it takes in a sweep.
struct SweepAxis {
  std::string option;               ///< as in configs: tau_s
  std::string unit;                 ///< empty where it has none
  std::vector<std::string> values;  ///< as options write them: "0.5", "power"
  std::vector<double> numbers;      ///< the same values where all are numbers, else empty
  bool is_logarithmic = false;      ///< given as a log range
};

/// What was asked for, not yet judged by the option: its name and its values in words, in the given order.
struct AskedAxis {
  std::string option;
  std::vector<std::string> values;
  bool is_logarithmic = false;
};

/// A list "0.5,1,2", a range "0.4:1.2:0.2" (first, last, step; the last is in it where the steps end there)
/// or a log range "log:1:8:4" (first, last, how many). Throws a usage Error that shows the forms, and for
/// more than 10,000 values.
AskedAxis parse_axis(std::string_view name, std::string_view values);

/// "tau_s=0.5,1,2".
AskedAxis parse_axis(std::string_view assignment);

/// A list of values, or a text as above.
AskedAxis parse_axis(const std::string& name, const nlohmann::json& values);

/// The values as the option writes them; it is left with the last. Throws a usage Error for one that the
/// option doesn't take, and for one that is there twice.
SweepAxis checked_axis(const AskedAxis& asked, VariableOption& option);

}  // namespace esi

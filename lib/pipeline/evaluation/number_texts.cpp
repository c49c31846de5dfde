#include "esi/pipeline/evaluation/number_texts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace esi {

std::string decimal_text(const std::optional<double>& number, int decimals) {
  return number ? fmt::format("{:.{}f}", *number, decimals) : std::string();
}

std::string share_text(const Rate& rate) {
  if (!rate.value()) return "-";
  return fmt::format("{}/{} ({:.1f} %)", rate.hits, rate.of, 100.0 * *rate.value());
}

std::string tenths_text(double number) {
  return fmt::format("{:.1f}", std::abs(number) < 0.05 ? 0.0 : number);
}

std::string percent_range_text(const std::optional<ConfidenceInterval>& interval) {
  return interval ? tenths_text(100.0 * interval->low) + ".." + tenths_text(100.0 * interval->high) : "-";
}

void add_interval(std::vector<std::string>& row, const std::optional<ConfidenceInterval>& interval) {
  row.push_back(interval ? fmt::format("{:.6f}", interval->low) : "");
  row.push_back(interval ? fmt::format("{:.6f}", interval->high) : "");
}

}  // namespace esi

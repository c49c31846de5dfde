#pragma once

#include <string>
#include <vector>

namespace esi {

/// A table of texts, not yet escaped for any format. Every row has as many cells as there are columns.
struct Table {
  std::string caption;  ///< empty where there is none
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Names of columns first; no caption.
std::string to_csv(const Table& table);

/// The first column to the left, the others to the right.
std::string to_markdown(const Table& table);

/// A `tabular` with the rules of the booktabs package, in a `table` with caption where there is one.
std::string to_tex(const Table& table);

/// A `table` element.
std::string to_html(const Table& table);

}  // namespace esi

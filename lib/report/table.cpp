#include "esi/report/table.hpp"

#include <fmt/format.h>

#include <string_view>

#include "esi/report/escape.hpp"

namespace esi {
namespace {

using Cells = std::vector<std::string>;

template <class Escape>
std::string joined(const Cells& cells, std::string_view separator, Escape escape) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += separator;
    line += escape(cells[i]);
  }
  return line;
}

std::string html_row(const Cells& cells, std::string_view element) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", element, html_text(cell));
  return row + "</tr>\n";
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string text = joined(table.columns, ",", csv_field) + '\n';
  for (const Cells& row : table.rows) text += joined(row, ",", csv_field) + '\n';
  return text;
}

std::string to_markdown(const Table& table) {
  std::string text;
  if (!table.caption.empty()) text += markdown_cell(table.caption) + "\n\n";
  text += "| " + joined(table.columns, " | ", markdown_cell) + " |\n|---|";
  for (std::size_t i = 1; i < table.columns.size(); ++i) text += "---:|";
  text += '\n';
  for (const Cells& row : table.rows) text += "| " + joined(row, " | ", markdown_cell) + " |\n";
  return text;
}

std::string to_tex(const Table& table) {
  const std::size_t numbers = table.columns.empty() ? 0 : table.columns.size() - 1;
  std::string text = fmt::format("\\begin{{tabular}}{{l{}}}\n\\toprule\n", std::string(numbers, 'r'));
  text += joined(table.columns, " & ", tex_text) + " \\\\\n\\midrule\n";
  for (const Cells& row : table.rows) text += joined(row, " & ", tex_text) + " \\\\\n";
  text += "\\bottomrule\n\\end{tabular}\n";
  if (table.caption.empty()) return text;
  return fmt::format("\\begin{{table}}\n\\centering\n\\caption{{{}}}\n{}\\end{{table}}\n",
                     tex_text(table.caption), text);
}

std::string to_html(const Table& table) {
  std::string text = "<table>\n";
  if (!table.caption.empty()) text += fmt::format("<caption>{}</caption>\n", html_text(table.caption));
  text += "<thead>" + html_row(table.columns, "th") + "</thead>\n<tbody>\n";
  for (const Cells& row : table.rows) text += html_row(row, "td");
  return text + "</tbody>\n</table>\n";
}

}  // namespace esi

#pragma once

#include <string>
#include <string_view>

// Names of phases, methods and files may hold anything. Each output format has characters that mean something
// else there; these functions make them mean themselves.

namespace esi {

/// RFC 4180: in quotes where it holds a comma, a quote or the end of a line.
std::string csv_field(std::string_view text);

/// For HTML and SVG, in text as well as in quoted attributes. Control characters become U+FFFD.
std::string html_text(std::string_view text);

/// LaTeX outside of mathematics. Ends of lines become blanks.
std::string tex_text(std::string_view text);

/// A cell of a Markdown table. Ends of lines become blanks.
std::string markdown_cell(std::string_view text);

}  // namespace esi

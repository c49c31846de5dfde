#include "esi/report/escape.hpp"

namespace esi {
namespace {

/// `replacement(c)` is what stands for a character, or nullptr for itself.
template <class Replacement>
std::string replaced(std::string_view text, Replacement replacement) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (const char* const other = replacement(c)) {
      result += other;
    } else {
      result += c;
    }
  }
  return result;
}

const char* for_html(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\t':
    case '\n':
    case '\r':
      return nullptr;
    default:
      // XML has no control characters; U+FFFD stands for them.
      return static_cast<unsigned char>(c) < 0x20U ? "\xEF\xBF\xBD" : nullptr;
  }
}

const char* for_tex(char c) {
  switch (c) {
    case '\\':
      return "\\textbackslash{}";
    case '~':
      return "\\textasciitilde{}";
    case '^':
      return "\\textasciicircum{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '"':
      return "\\textquotedbl{}";
    case '{':
      return "\\{";
    case '}':
      return "\\}";
    case '$':
      return "\\$";
    case '&':
      return "\\&";
    case '#':
      return "\\#";
    case '_':
      return "\\_";
    case '%':
      return "\\%";
    case '\n':
    case '\r':
      return " ";
    default:
      return nullptr;
  }
}

const char* for_markdown(char c) {
  switch (c) {
    case '\\':
      return "\\\\";
    case '|':
      return "\\|";
    case '*':
      return "\\*";
    case '_':
      return "\\_";
    case '`':
      return "\\`";
    case '[':
      return "\\[";
    case ']':
      return "\\]";
    case '$':
      return "\\$";
    case '#':
      return "\\#";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '&':
      return "&amp;";
    case '\n':
    case '\r':
      return " ";
    default:
      return nullptr;
  }
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  return '"' + replaced(text, [](char c) { return c == '"' ? "\"\"" : nullptr; }) + '"';
}

std::string html_text(std::string_view text) { return replaced(text, for_html); }
std::string tex_text(std::string_view text) { return replaced(text, for_tex); }
std::string markdown_cell(std::string_view text) { return replaced(text, for_markdown); }

}  // namespace esi

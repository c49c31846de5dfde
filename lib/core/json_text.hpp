#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace esi {

/// Parses one JSON document strictly. Throws a usage Error "NAME: ... (line L, column C)" on syntax errors,
/// duplicate keys, text behind the document, and nesting deeper than 64.
/// `name` is what the message calls the text, usually the file's path.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// For files and for people: indented, a line break at the end; bytes that aren't UTF-8 are replaced.
std::string json_text(const nlohmann::json& json);

}  // namespace esi

#include "esi/core/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "esi/core/error.hpp"

namespace esi {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 64;

// Watches a parse for what the library lets pass: duplicate keys and bottomless nesting.
class StrictEvents {
 public:
  explicit StrictEvents(std::string name) : name_(std::move(name)) {}

  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    using Parse = json::parse_event_t;
    if (depth > kMaxDepth) fail(fmt::format("nested deeper than {} levels", kMaxDepth));
    if (event == Parse::object_start) keys_.emplace_back();
    if (event == Parse::object_end) keys_.pop_back();
    if (event == Parse::key && !keys_.back().insert(parsed.get<std::string>()).second) {
      fail(fmt::format("the key {} is there twice", parsed.dump()));
    }
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw usage_error(name_ + ": " + what); }

  std::string name_;
  std::vector<std::set<std::string>> keys_;
};

std::string place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte == 0 ? 0 : std::min(byte - 1, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return fmt::format("line {}, column {}", line, before.size() - line_start + 1);
}

// The library's own words without its tag and without its own idea of the place:
// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ..."
std::string reason_of(const json::parse_error& error) {
  const std::string text = error.what();
  const std::size_t colon = text.find(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

}  // namespace

json parse_json(std::string_view text, const std::string& name) {
  try {
    return json::parse(text, StrictEvents(name));
  } catch (const json::parse_error& error) {
    throw usage_error(fmt::format("{}: {} ({})", name, reason_of(error), place_of(text, error.byte)));
  } catch (const json::out_of_range&) {
    throw usage_error(name + ": a number is too large");
  }
}

std::string json_text(const json& document) {
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace esi

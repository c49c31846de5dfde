#include "bad_input/bad_input.hpp"

namespace esi::test {
namespace {

const std::vector<std::string> kSize = {"--size", "12x9"};

std::function<std::string()> raw(std::string text) {
  return [text = std::move(text)] { return text; };
}

}  // namespace

BadInputs bad_configs() {
  return {"Configs (JSON)",
          "config.json",
          {
              {"good", 0, "", raw(R"({"method": "esi", "set": {"tau_s": 2}, "fps": 50})"), kSize},
              {"empty", 2, "line 1, column 1", raw(""), kSize},
              {"syntax error", 2, "line 2, column 10", raw("{\n  \"fps\": }"), kSize},
              {"text behind the end", 2, "line 1, column 13", raw(R"({"fps": 50} x)"), kSize},
              {"the same key twice", 2, "is there twice", raw(R"({"fps": 50, "fps": 60})"), kSize},
              {"unknown key", 2, "did you mean", raw(R"({"fsp": 50})"), kSize},
              {"unknown option of the method", 2, "tau_s", raw(R"({"set": {"tau": 50}})"), kSize},
              {"unknown method", 2, "did you mean", raw(R"({"method": "eis"})"), kSize},
              {"text for a number", 2, "fps", raw(R"({"fps": "fast"})"), kSize},
              {"number for a text", 2, "roi", raw(R"({"roi": 7})"), kSize},
              {"out of range", 2, "fps", raw(R"({"fps": 0})"), kSize},
              {"number too large for any type", 2, "too large", raw(R"({"fps": 1e999})"), kSize},
              {"NaN", 2, "line 1", raw(R"({"fps": NaN})"), kSize},
              {"a list, not an object", 2, "JSON object", raw("[]"), kSize},
              {"10^5 levels deep", 2, "nested deeper", raw(std::string(100000, '[')), kSize},
              {"binary", 2, "line 1", raw(std::string("\0\1\2\3", 4)), kSize},
          }};
}

}  // namespace esi::test

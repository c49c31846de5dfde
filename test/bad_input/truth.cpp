#include "bad_input/bad_input.hpp"

namespace esi::test {
namespace {

std::function<std::string()> raw(std::string text) {
  return [text = std::move(text)] { return text; };
}

/// Phases of these names, starts and ends.
std::function<std::string()> phases(const std::string& list) { return raw(R"({"phases": [)" + list + "]}"); }

/// One good phase, and more.
std::function<std::string()> with(const std::string& more) {
  return raw(R"({"phases": [{"name": "a", "start_s": 0, "end_s": 0.2}], )" + more + "}");
}

}  // namespace

BadInputs bad_truths() {
  const std::string first = R"({"name": "a", "start_s": 0, "end_s": 0.1})";
  return {
      "Ground truth (esi-eval)",
      "ground_truth.json",
      {
          {"good", 0, "", phases(first), {}},
          {"name with comma, quotes, `_&%$#`, HTML and a line's end",
           0,
           "",
           phases(R"({"name": "a, \"b\" _&%$# <script>\n", "start_s": 0, "end_s": 0.1})"),
           {}},
          {"empty file", 2, "line 1, column 1", raw(""), {}},
          {"a list, not an object", 2, "not a JSON object", raw("[]"), {}},
          {"no phases", 2, "phases is missing", raw("{}"), {}},
          {"phases empty", 2, "at least one phase", phases(""), {}},
          {"end at start", 2, "not after", phases(R"({"name": "a", "start_s": 1, "end_s": 1})"), {}},
          {"end before start", 2, "not after", phases(R"({"name": "a", "start_s": 2, "end_s": 1})"), {}},
          {"phases overlap",
           2,
           "overlap from 0.05",
           phases(first + R"(, {"name": "b", "start_s": 0.05, "end_s": 0.2})"),
           {}},
          {"the same name twice",
           2,
           "there twice",
           phases(first + R"(, {"name": "a", "start_s": 0.1, "end_s": 0.2})"),
           {}},
          {"phases outside the recording",
           2,
           "the recording from 0.0",
           phases(R"({"name": "a", "start_s": 7, "end_s": 8})"),
           {}},
          {"milliseconds", 2, "milliseconds", phases(R"({"name": "a", "start_s": 50, "end_s": 180})"), {}},
          {"milliseconds from 0 on",
           2,
           "milliseconds",
           phases(R"({"name": "a", "start_s": 0, "end_s": 200})"),
           {}},
          {"NaN", 2, "line 1", phases(R"({"name": "a", "start_s": NaN, "end_s": 1})"), {}},
          {"number too large", 2, "too large", phases(R"({"name": "a", "start_s": 0, "end_s": 1e999})"), {}},
          {"text for a number", 2, "start_s", phases(R"({"name": "a", "start_s": "0", "end_s": 1})"), {}},
          {"no name", 2, "name is missing", phases(R"({"start_s": 0, "end_s": 1})"), {}},
          {"empty name", 2, "name is empty", phases(R"({"name": "", "start_s": 0, "end_s": 1})"), {}},
          {"unknown key", 2, "did you mean", with(R"("corner": "corners.csv")"), {}},
          {"unknown key of a phase",
           2,
           "did you mean",
           phases(R"({"name": "a", "start_s": 0, "end_s": 1, "ends_s": 2})"),
           {}},
          {"unknown family", 2, "tag36h12", with(R"("tags": {"family": "tag36h12", "ids": [0]})"), {}},
          {"another family than the detector's",
           2,
           "--family tag16h5",
           with(R"("tags": {"family": "tag16h5", "ids": [0]})"),
           {}},
          {"id outside the family",
           2,
           "0 to 586",
           with(R"("tags": {"family": "tag36h11", "ids": [587]})"),
           {}},
          {"camera of another size",
           2,
           "346x260",
           with(R"("camera": {"width": 346, "height": 260, "fx": 1, "fy": 1, "cx": 1, "cy": 1})"),
           {}},
          {"corners.csv is absent", 1, "absent.csv", with(R"("corners": "absent.csv")"), {}},
          {"corners.csv is JSON", 2, "ground_truth.json", with(R"("corners": "ground_truth.json")"), {}},
          {"a track is absent", 1, "absent.tum", with(R"("camera_poses": "absent.tum")"), {}},
          {"clean frames are absent", 1, "absent.txt", with(R"("clean_frames": "absent.txt")"), {}},
          {"clean frames are a folder", 1, ".", with(R"("clean_frames": ".")"), {}},
      }};
}

}  // namespace esi::test

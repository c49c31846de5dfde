#include "bad_input/bad_input.hpp"
#include "support/prophesee_file.hpp"
#include "support/recordings.hpp"

namespace esi::test {
namespace {

const std::vector<std::string> kNone = {};

std::string cut(const std::string& bytes, std::size_t by) { return bytes.substr(0, bytes.size() - by); }

std::string evt3() { return evt3_recording(moving_edge(600)); }

}  // namespace

BadInputs bad_prophesee() {
  return {"Prophesee RAW and DAT",
          "recording.raw",
          {
              {"EVT3 cut within a word", 3, "1 cut_packet", [] { return cut(evt3(), 1); }, kNone},
              {"EVT2 cut within a word", 3, "1 cut_packet",
               [] { return cut(evt2_recording(moving_edge(600)), 3); }, kNone},
              {"EVT2.1", 0, "", [] { return evt21_recording(moving_edge(600)); }, kNone},
              {"header without an encoding", 1, "evt",
               [] {
                 return prophesee_lines({"system_ID 48", "serial_number 1", "end"}) +
                        words16(evt3_words(moving_edge(9)));
               },
               kNone},
              {"unknown encoding", 1, "EVT9",
               [] {
                 return prophesee_lines({"format EVT9;height=180;width=240", "end"}) + "12345678";
               },
               kNone},
              {"no geometry and unknown system", 2, "--size",
               [] { return prophesee_lines({"evt 3.0"}) + words16(evt3_words(moving_edge(600))); }, kNone},
              {"only the header", 1, "no events",
               [] {
                 return prophesee_lines({"format EVT3;height=180;width=240", "end"});
               },
               kNone},
              {"words of other kinds among the events", 0, "",
               [] {
                 return evt3() +
                        words16({evt3_word(0xE, 1), evt3_word(0xF, 2), evt3_word(0x7, 3), evt3_word(0xA, 1)});
               },
               kNone},
              {"DAT of triggers", 1, "14",
               [] { return std::string("% Data file\n% Version 2\n\x0e\x08") + "1234567812345678"; }, kNone},
              {"DAT cut within an event",
               3,
               "1 cut_packet",
               [] { return cut(dat_recording(moving_edge(600)), 3); },
               {"--size", "240x180"}},
              {"DAT without a size", 2, "--size",
               [] {
                 return std::string("% Data file\n% Version 2\n\x0c\x08") +
                        words64({dat_record(1, 2, 3, true)});
               },
               kNone},
          }};
}

}  // namespace esi::test

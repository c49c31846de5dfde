// libFuzzer's entry to one target, ESI_FUZZ_TARGET.
#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  esi::fuzz::run(ESI_FUZZ_TARGET, {data, size});
  return 0;
}

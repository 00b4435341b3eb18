// One libFuzzer program; FUZZ_TARGET says of which target.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/computations.h"
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plenum::fuzz::FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}

// libFuzzer's entry; CONTRIBUTING.md says how to run it.

#include <cstddef>
#include <cstdint>

#include "fuzz/read_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pelage::read_and_use_model({reinterpret_cast<const char*>(data), size});
  return 0;
}

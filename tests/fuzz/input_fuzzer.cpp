// libFuzzer's entries; CONTRIBUTING.md says how to run it. "--reader=NAME" picks what the bytes are.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "base/parallel.h"
#include "fuzz/read_input.h"

namespace {

const pelage::InputReader* reader = nullptr;

constexpr std::string_view option = "--reader=";

}  // namespace

extern "C" int LLVMFuzzerInitialize(const int* argc, char*** argv) {
  try {
    std::string_view name;
    for (int i = 1; i < *argc; ++i)
      if (const std::string_view word = (*argv)[i]; word.starts_with(option)) name = word.substr(option.size());
    reader = &pelage::input_reader(name);
    static const pelage::ThreadLimit one(1);  // a fuzzer of its own is on every core
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reader->read({reinterpret_cast<const char*>(data), size});
  return 0;
}

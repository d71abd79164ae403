#pragma once
// What the fuzzer and the test of its corpus do with bytes: read them as a file of some kind, and use what was read.

#include <cstddef>
#include <string_view>
#include <vector>

namespace pelage {

/// Reads bytes as an input of one kind and uses what was read. Faults of the input are expected (Error); anything else
/// is a bug: other exceptions escape, broken promises are std::logic_error, and wrong memory accesses are for the
/// sanitizers.
struct InputReader {
  const char* name;
  void (*read)(std::string_view bytes);
};

/// All kinds of input that the program has. Those that lie beside another file (mtl, buffers) and images are read from
/// a folder of their own among the temporary files, which is removed at the end.
const std::vector<InputReader>& input_readers();

/// The one of that name; std::invalid_argument, with all names, if there is none.
const InputReader& input_reader(std::string_view name);

/// No input needs more memory at once than this: what an input claims is not what it holds.
inline constexpr std::size_t most_memory = std::size_t{1} << 30;  // bytes

}  // namespace pelage

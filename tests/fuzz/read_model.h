#pragma once
// What the fuzzer and the test of its corpus do with a text: read it as a model, and use what was read.

#include <string_view>

namespace pelage {

/// Parses, compiles, analyses and evaluates the model that the text describes. Faults of the text are expected;
/// anything else is a bug: other exceptions escape, and wrong memory accesses are for the sanitizers.
void read_and_use_model(std::string_view text);

}  // namespace pelage

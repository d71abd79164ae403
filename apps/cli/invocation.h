#pragma once
// How the program was called.

#include <string>
#include <vector>

namespace pelage {

/// The words after the name of the program, and the folder in which relative paths count.
struct Invocation {
  std::vector<std::string> words;
  std::string folder;
};

/// Of the command that runs.
const Invocation& invocation();
void set_invocation(Invocation now);

}  // namespace pelage

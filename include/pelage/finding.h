#pragma once
// What the checks of a shape note.

#include <cstddef>
#include <string>

namespace pelage {

/// Something unusual in a shape. Vertices and faces are counted from 0, in the order of the file.
struct Finding {
  std::string kind;         ///< short fixed name for programs, for example "duplicate-faces"
  std::string text;         ///< one line for people: what, how many, the first one, what was done
  std::size_t count = 0;    ///< how many elements are concerned
  std::size_t element = 0;  ///< the first of them
  bool repaired = false;    ///< false: only noted, the shape is used as it is
};

}  // namespace pelage

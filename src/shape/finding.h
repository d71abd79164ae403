#pragma once
// What the checks of a shape say: findings (repaired or only noted) and faults (the shape is refused).

#include <cstddef>
#include <string>

#include "pelage/error.h"

namespace pelage {

/// "1 face", "30 faces".
inline std::string counted(std::size_t count, const std::string& noun) {
  if (count == 1) return "1 " + noun;
  return std::to_string(count) + " " + (noun == "vertex" ? "vertices" : noun + "s");
}

/// Something unusual in a shape. Vertices and faces are counted from 0, in the order of the file.
struct Finding {
  std::string kind;         ///< short fixed name for programs, for example "duplicate-faces"
  std::string text;         ///< one line for people: what, how many, the first one, what was done
  std::size_t count = 0;    ///< how many elements are concerned
  std::size_t element = 0;  ///< the first of them
  bool repaired = false;    ///< false: only noted, the shape is used as it is
};

/// A shape that cannot be used. Carries the element at fault, so that a reader can add file and line.
class ShapeFault : public Error {
 public:
  enum class Element { none, vertex, face };

  /// what() is "face 12: message", "vertex 12: message" or the message alone.
  ShapeFault(Element element, std::size_t index, const std::string& message)
      : Error(Fault::input, name(element, index) + message), element_(element), index_(index) {}

  Element element() const { return element_; }
  std::size_t index() const { return index_; }

 private:
  static std::string name(Element element, std::size_t index) {
    if (element == Element::none) return "";
    return (element == Element::vertex ? "vertex " : "face ") + std::to_string(index) + ": ";
  }

  Element element_;
  std::size_t index_;
};

}  // namespace pelage

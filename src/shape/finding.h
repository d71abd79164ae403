#pragma once
// What the checks of a shape say: findings (pelage/finding.h) and faults, for which the shape is refused.

#include <cstddef>
#include <string>

#include "pelage/error.h"
#include "pelage/finding.h"

namespace pelage {

/// "1 face", "30 faces".
inline std::string counted(std::size_t count, const std::string& noun) {
  if (count == 1) return "1 " + noun;
  return std::to_string(count) + " " + (noun == "vertex" ? "vertices" : noun + (noun == "patch" ? "es" : "s"));
}

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

#include "catalog/quality.h"

namespace pelage {

// docs/performance.md has the errors against the time that they take.
std::span<const Quality> qualities() {
  static constexpr Quality all[] = {
      {"draft", "at once", 0.8, 5, 8},
      {"normal", "as good as a picture shows", 1, 1, 32},
      {"fine", "for measurements", 1.7, 0.03, 32},
  };
  return all;
}

}  // namespace pelage

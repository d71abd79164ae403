#include "discretise/method.h"

namespace pelage {

std::span<const Method* const> methods() {
  static constexpr const Method* all[] = {&remeshed_method, &loop_method, &linear_method, &grid_method,
                                          &tets_method,     &mask_method, &cell_method,   &turk_method};
  return all;
}

}  // namespace pelage

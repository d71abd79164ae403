#pragma once
// Discretisations by the name of their method.

#include <string>

#include "discretise/discretisation.h"

namespace pelage {

inline Discretisation make_discretisation(const std::string& method, Topology topology) {
  return method == "linear" ? linear_discretisation(std::move(topology)) : loop_discretisation(std::move(topology));
}

}  // namespace pelage

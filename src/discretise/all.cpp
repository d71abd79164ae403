#include "discretise/discretisation.h"
#include "pelage/error.h"

namespace pelage {

namespace {

struct Method {
  const char* name;
  Discretisation (*make)(Topology);
};

constexpr Method methods[] = {
    {"loop", loop_discretisation},
    {"linear", linear_discretisation},
};

}  // namespace

Discretisation make_discretisation(const std::string& method, Topology topology) {
  for (const Method& m : methods)
    if (method == m.name) return m.make(std::move(topology));
  throw Error(Fault::usage, "unknown method '" + method + "'; known are loop and linear");
}

}  // namespace pelage

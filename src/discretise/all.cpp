#include "discretise/discretisation.h"
#include "pelage/error.h"

namespace pelage {

namespace {

struct Method {
  const char* name;
  Discretisation (*make)(Topology);
};

Discretisation default_loop(Topology topology) { return loop_discretisation(std::move(topology)); }

constexpr Method methods[] = {
    {"loop", default_loop},
    {"linear", linear_discretisation},
};

}  // namespace

Discretisation make_discretisation(const std::string& method, Topology topology) {
  for (const Method& m : methods)
    if (method == m.name) return m.make(std::move(topology));
  throw Error(Fault::usage, "unknown method '" + method + "'; known are loop and linear");
}

}  // namespace pelage

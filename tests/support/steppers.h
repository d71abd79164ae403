#pragma once
// Steppers by name, for parameterised tests.

#include <string>
#include <vector>

#include "pelage/error.h"
#include "time/stepper.h"

namespace pelage {

/// Those that work on every space.
inline std::vector<std::string> stepper_names() {
  std::vector<std::string> names;
  for (const StepperKind* kind : stepper_kinds())
    if (!kind->nodal && !kind->lattice) names.emplace_back(kind->name);
  return names;
}

inline const StepperKind& stepper_named(const std::string& name) {
  for (const StepperKind* kind : stepper_kinds())
    if (kind->name == name) return *kind;
  throw Error(Fault::usage, "no stepper " + name);
}

inline std::unique_ptr<Stepper> make_stepper(const std::string& name) { return stepper_named(name).make(); }

/// The name as googletest takes it.
template <class Info>
std::string stepper_test_name(const Info& info) {
  std::string name = info.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

}  // namespace pelage

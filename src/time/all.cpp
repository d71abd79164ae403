#include "base/suggest.h"
#include "pelage/error.h"
#include "time/stepper.h"

namespace pelage {

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Stepper> (*make)();
};

constexpr Entry steppers[] = {
    {"sbdf2", make_sbdf2},
    {"paper", make_paper},
    {"explicit", make_explicit},
};

}  // namespace

std::vector<std::string> stepper_names() {
  std::vector<std::string> names;
  for (const Entry& e : steppers) names.emplace_back(e.name);
  return names;
}

std::unique_ptr<Stepper> make_stepper(const std::string& name) {
  for (const Entry& e : steppers)
    if (name == e.name) return e.make();
  throw Error(Fault::usage, unknown_name("stepper", name, stepper_names()));
}

}  // namespace pelage

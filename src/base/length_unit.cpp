#include "base/length_unit.h"

#include "base/number.h"

namespace pelage {

namespace {

struct Unit {
  const char* name;
  double metres;
};

constexpr Unit units[] = {{"um", 1e-6},   {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254},
                          {"ft", 0.3048}, {"m", 1.0},   {"km", 1e3}};

}  // namespace

std::optional<double> metres_in(std::string_view unit) {
  for (const Unit& u : units)
    if (unit == u.name) return u.metres;
  return {};
}

std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const Unit& u : units) names.emplace_back(u.name);
  return names;
}

std::string unit_name(double metres) {
  for (const Unit& u : units)
    if (metres == u.metres) return u.name;
  return "units of " + number(metres) + " m";
}

std::string length_in_words(double metres) { return metres < 1 ? number(1e3 * metres) + " mm" : number(metres) + " m"; }

}  // namespace pelage

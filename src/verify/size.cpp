#include <algorithm>
#include <cmath>

#include "catalog/bind.h"
#include "run/run.h"
#include "verify/figure.h"
#include "verify/triangulations.h"

namespace pelage {

namespace {

constexpr double size = 0.6;  // about 40 spots on the unit sphere

/// Measured wavelength of the finished pattern over the size that was asked for. Of the faster diffusing species: its
/// pattern has hardly any harmonics, which would shorten the measured length.
double relative_wavelength(SphereTriangulation triangulation) {
  Recipe recipe;
  recipe.stages[0].model.value = "turing";
  recipe.stages[0].size = Given<Length>{{size, Length::Unit::world}, {}};
  recipe.stages[0].interpolate = true;
  Run run(make_program(recipe, unit_sphere(triangulation, 1002)));
  while (!run.done()) run.advance(100);
  if (run.summary().status == RunStatus::failed) return 0;
  return measured_wavelength(*run.system().mass, *run.space().stiffness(), run.coefficients()[0]) / size;
}

}  // namespace

std::vector<Figure> verify_size() {
  std::vector<Figure> figures;
  double shortest = 1e300, longest = 0;
  for (auto [name, triangulation] :
       {std::pair{"uniform", SphereTriangulation::uniform}, std::pair{"graded 1:10", SphereTriangulation::graded},
        std::pair{"with slivers", SphereTriangulation::slivers}}) {
    const double ratio = relative_wavelength(triangulation);
    shortest = std::min(shortest, ratio);
    longest = std::max(longest, ratio);
    figures.push_back(at_most(std::string("distance of the measured wavelength from the size, sphere ") + name,
                              std::abs(ratio - 1), 0.1));
  }
  figures.push_back(
      at_most("spread of the measured wavelength over these three triangulations", longest / shortest - 1, 0.05));
  return figures;
}

}  // namespace pelage

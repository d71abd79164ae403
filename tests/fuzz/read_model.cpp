#include "fuzz/read_model.h"

#include <vector>

#include "catalog/models.h"
#include "pelage/error.h"
#include "react/kinetics.h"
#include "react/stability.h"
#include "react/wavelength.h"

namespace pelage {

namespace {

void evaluate(const Model& model) {
  const std::vector<Point> place = {{0.1, -0.2, 0.3}, {1, 2, 3}, {-4, 5, 6}};
  const std::vector<double> zero(place.size(), 0.0);
  const Kinetics kinetics(model, {.positions = place, .normals = place, .k1 = zero, .k2 = zero}, 1);
  const std::size_t n = model.species_count();
  std::vector<std::vector<double>> u(n, std::vector<double>(place.size())), rate = u;
  std::vector<const double*> in;
  std::vector<double*> out;
  for (std::size_t i = 0; i < n; ++i) {
    kinetics.initial(i, u[i]);
    in.push_back(u[i].data());
    out.push_back(rate[i].data());
  }
  in.resize(kinetics.input_count(), zero.data());  // products of gradients
  kinetics.rates(in, 0.5, 0, place.size(), out);
}

}  // namespace

void read_and_use_model(std::string_view text) {
  try {
    const Model model = compile(parse_model(text, "fuzz.toml"));
    analyse(model);
    known_wavelength(model);
    evaluate(model);
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): a fault of the text, reported
  }
}

}  // namespace pelage

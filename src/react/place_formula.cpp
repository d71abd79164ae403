#include "react/place_formula.h"

#include "react/place_values.h"

namespace pelage {

PlaceFormula::PlaceFormula(const Formula& formula, std::vector<DefinitionSource> definitions) {
  ModelSource source;
  source.name = "formula";
  source.definitions = std::move(definitions);
  source.definitions.push_back({"formula_of_the_place", formula});
  SpeciesSource& value = source.species.emplace_back();
  value.name = "value_of_the_formula";
  value.where = formula.where;
  value.diffusion = value.rate = Formula{"0", formula.where};
  value.initial = Formula{"formula_of_the_place", formula.where};
  model_ = compile(source);
}

std::vector<Symbol> PlaceFormula::symbols() const { return place_symbols(model_); }

std::vector<double> PlaceFormula::at(const Places& places, std::uint64_t seed) const {
  const Kinetics kinetics(model_, places, seed);
  std::vector<double> values(kinetics.size());
  kinetics.initial(0, values);
  return values;
}

}  // namespace pelage

#pragma once
// A single formula of the place: maps, masks, opacities.

#include <vector>

#include "react/kinetics.h"

namespace pelage {

class PlaceFormula {
 public:
  /// Error(usage), located, when it is not a formula, or depends on time. It may use the definitions.
  explicit PlaceFormula(const Formula& formula, std::vector<DefinitionSource> definitions = {});

  /// What it reads from the place.
  std::vector<Symbol> symbols() const;
  /// One value per sample. Error(usage), located, where the places lack what it reads.
  std::vector<double> at(const Places& places, std::uint64_t seed = 0) const;

 private:
  Model model_;  ///< of one species, whose initial value is the formula
};

}  // namespace pelage

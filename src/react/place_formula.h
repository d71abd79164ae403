#pragma once
// A single formula of the place: maps, marks, opacities.

#include <optional>
#include <vector>

#include "react/kinetics.h"

namespace pelage {

class PlaceFormula {
 public:
  /// Error(usage), located, when it is not a formula, or depends on more than the place. Each of `names` stands for the
  /// attribute of that name, each of `numbers` for its value.
  explicit PlaceFormula(const Formula& formula, const std::vector<std::string>& names = {},
                        const std::map<std::string, double>& numbers = {});

  /// Of a condition, which compares numbers: a formula that is above 0 where it holds and below where it does not, as
  /// continuous as what it compares. "a == b" then holds where they differ by less than 0.5. Nothing where this is a
  /// number.
  std::optional<PlaceFormula> margin() const;

  /// What it reads from the place.
  std::vector<Symbol> symbols() const;
  /// One value per sample. Error(usage), located, where the places lack what it reads.
  std::vector<double> at(const Places& places, std::uint64_t seed = 0) const;

 private:
  Graph graph_;
  NodeId root_;
};

}  // namespace pelage

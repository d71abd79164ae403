#pragma once
// What holds at the sides of a grid instead of no flux: values (Dirichlet), or inflows that may depend on the value
// there (Neumann, Robin).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discretise/space.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "react/place_formula.h"

namespace pelage {

/// A formula of the place and of the time t, for which its symbol "t" stands.
struct BorderFormula {
  PlaceFormula formula;  ///< knows t as an attribute
  std::string text;

  /// `numbers`: the parameters of the model. Error(usage), located.
  BorderFormula(const Formula& source, const std::map<std::string, double>& numbers)
      : formula(source, {"t"}, numbers), text(source.text) {}
};

/// Of one species at one side: u = value, or n . T grad u = flux - loss u with the normal n outwards and the diffusion
/// T, in the units of the model: flux [concentration length / time], loss [length / time].
struct BorderCondition {
  std::string side;  ///< of Space::border
  Location where;
  std::size_t species = 0;
  std::optional<BorderFormula> value, flux, loss;
};

/// Conditions on a space.
class Borders {
 public:
  /// The stage has to outlive it.
  Borders(const struct StageProgram& stage, const Space& space);

  /// Whether species i has given values somewhere, or inflows.
  bool gives_values(std::size_t species) const;
  bool any_inflow() const;
  /// `held` (or nothing, if null) and where the values of species i are given.
  std::shared_ptr<const Held> held(std::size_t species, const Held* held) const;
  /// Puts the values at time t in their places.
  void set_values(std::size_t species, double t, Vector& u) const;
  /// Adds the loads of all inflows at time t.
  void add_inflows(const std::vector<Vector>& u, double t, std::vector<Vector>& loads) const;

 private:
  struct Side {
    const BorderCondition* condition;
    SpaceBorder border;
    std::vector<Point> position, normal;  ///< of the nodes, and of two corners of the space's box, which formulas read
  };
  std::vector<double> values(const Side& side, const BorderFormula& formula, double t) const;

  const StageProgram* stage_;
  std::vector<Side> sides_;
  Index unknowns_;
};

}  // namespace pelage

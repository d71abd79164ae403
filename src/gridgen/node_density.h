#pragma once
// Where a grid has more nodes than elsewhere.

#include <memory>
#include <span>

#include "gridgen/formula_function.h"
#include "gridgen/plane_field.h"

namespace pelage {

/// A formula of x, y and z, and, where there is a field, of its attributes: nodes per area are in proportion.
class NodeDensity {
 public:
  explicit NodeDensity(FormulaFunction formula, std::shared_ptr<const PlaneField> field = nullptr)
      : formula_(std::move(formula)), field_(std::move(field)) {}

  /// The variables of such a formula, in its order.
  static std::vector<std::string> variables(const PlaneField* field);

  /// Values, and their derivatives by x, y and z. Error(usage), located, where one is not greater than 0.
  std::vector<std::vector<double>> with_gradient(std::span<const Point> points) const;

 private:
  FormulaFunction formula_;
  std::shared_ptr<const PlaneField> field_;
};

}  // namespace pelage

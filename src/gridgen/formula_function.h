#pragma once
// A formula as a function of named variables, with its derivatives: curves, surfaces, densities of nodes.

#include <map>
#include <span>
#include <string>
#include <vector>

#include "react/formula.h"

namespace pelage {

class FormulaFunction {
 public:
  /// Error(usage), located, when it is not a formula, or reads anything but the variables and the numbers.
  FormulaFunction(const Formula& formula, const std::vector<std::string>& variables,
                  const std::map<std::string, double>& numbers = {});

  /// One value per place; values[k] holds variable k at all places.
  std::vector<double> at(const std::vector<std::vector<double>>& values) const;
  /// The same, followed by the derivative with respect to each variable.
  std::vector<std::vector<double>> with_gradient(const std::vector<std::vector<double>>& values) const;
  const Location& where() const { return where_; }

 private:
  std::vector<std::vector<double>> evaluate(std::span<const NodeId> roots,
                                            const std::vector<std::vector<double>>& values) const;

  Location where_;
  std::vector<std::string> variables_;
  Graph graph_;
  std::vector<NodeId> roots_;  ///< the formula, then its derivatives
};

}  // namespace pelage

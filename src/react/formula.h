#pragma once
// The formula language: text -> expression.
//
//   a + b, a - b, a * b, a / b, -a, a^b      ^ binds tightest and to the right: -2^2 = -4, 2^3^2 = 2^9
//   < <= > >= == !=, and, or, not            logical values are 0 and 1
//   if(condition, a, b) min max abs exp log sqrt sin cos tan tanh erf pow(a, b) mod(a, b) floor
//   step(edge, x) = (x >= edge), smoothstep(edge0, edge1, x), clamp(x, lower, upper)
//   pi, e; t (time); x, y, z (place, world units); nx, ny, nz (unit normal);
//   bx, by, bz (place in the bounding box of the surface, from -1 to 1; 0 along a side without extent);
//   k1, k2, H (principal curvatures and their mean, 1 / world unit); attribute(name) (of the mesh, per vertex)
//   lap(u): surface Laplacian of a species u; in rate and equals only, times numbers and parameters (react/laplacian.h)
//   grad2(u), dot(grad u, grad v): products of surface gradients of species; in rate and equals only
//   div(c grad u): divergence of a flux with a formula c; in rate only, times numbers and parameters
//   norm(u), dot(u, v), cross(u, v): of vectors; u is one where u_1, u_2 and u_3 are names. In a formula for a
//   component k of a vector (Formula::component) u stands for u_k. uniform(a, b), normal(mean, deviation): white noise,
//   an independent draw at every place noise(length [, seed]): band-limited noise, mean 0, variance 1, length in the
//   model's own length unit
//
// Random functions are drawn once per run and depend on the place, not on any mesh. Every occurrence in a
// text is a field of its own, unless noise is given a seed: then all occurrences with that seed agree.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "react/expression.h"
#include "react/lexer.h"

namespace pelage {

/// Component 1, 2 or 3 of a vector as formulas name it.
inline std::string component_name(std::string_view vector, int k) {
  return std::string(vector) + "_" + std::to_string(k);
}

/// The names that a formula may use beside the built-in ones.
struct Scope {
  std::map<std::string, NodeId, std::less<>> names;
  std::map<std::string, std::string, std::less<>> not_yet;  ///< known names that may not be used here, and why
};

/// Parses a formula. `label` names it (for example "species.b.rate"): random fields are told apart by the label
/// and their order in the text. Error(usage) with line and column, saying what was expected; unknown names get
/// a suggestion. At most 10,000 characters and 100 levels of nesting.
NodeId parse_formula(Graph& graph, const Formula& formula, const Scope& scope, std::string_view label);

/// Functions, constants and built-in variables: names that a model may not give to its own quantities.
const std::vector<std::string>& reserved_names();

}  // namespace pelage

#include <cmath>

#include "shape/generators.h"
#include "shape/loop_subdivision.h"
#include "verify/figure.h"
#include "verify/problem.h"

namespace pelage {

namespace {

double area(const Discretisation& d, const std::vector<Point>& control) {
  double sum = 0;
  for (double w : quadrature_geometry(d, control).weight) sum += w;
  return sum;
}

double largest(const Vector& v) { return v.cwiseAbs().maxCoeff(); }

double asymmetry(const SparseMatrix& a) {
  const SparseMatrix t = transpose(a);
  double worst = 0, size = 0;
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    worst = std::max(worst, std::abs(a.value[k] - t.value[k]));
    size = std::max(size, std::abs(a.value[k]));
  }
  return worst / size;
}

std::vector<Figure> check(const std::string& name, const std::string& spec) {
  const TriangleMesh mesh = builtin_shape(spec);
  const Problem p = make_problem(mesh, make_loop, false);
  // The same quadrature points before and after subdivision, so that only the surface can make a difference.
  const Topology coarse = make_topology(mesh.points.size(), mesh.triangles);
  const Refinement fine = loop_refine(coarse);
  const double before = area(loop_discretisation(coarse, {.regular_splits = 2, .irregular_splits = 2}), mesh.points);
  const double after = area(loop_discretisation(make_topology(fine.stencils.rows(), fine.triangles),
                                                {.regular_splits = 1, .irregular_splits = 1}),
                            combine(fine.stencils, mesh.points));
  const Vector ones = Vector::Ones(p.discretisation.unknowns);
  const double total = area(p.discretisation, p.control);
  const Vector row_sums = p.stiffness * ones;
  return {at_most("area before and after subdivision, " + name, std::abs(after / before - 1), 1e-10),
          at_most("1'M1 against the area, " + name, std::abs(dot(ones, p.mass * ones) / total - 1), 1e-10),
          at_most("K1 over the largest entry of K, " + name, largest(row_sums) / largest(diagonal(p.stiffness)), 1e-10),
          at_most("asymmetry of M, " + name, asymmetry(p.mass), 1e-10),
          at_most("asymmetry of K, " + name, asymmetry(p.stiffness), 1e-10)};
}

}  // namespace

std::vector<Figure> verify_matrices() {
  std::vector<Figure> figures;
  for (auto [name, spec] :
       {std::pair{"sphere", "builtin:sphere?n=642"}, std::pair{"plane with boundary", "builtin:plane?n=400"},
        std::pair{"animal", "builtin:animal?n=3000"}}) {
    const auto part = check(name, spec);
    figures.insert(figures.end(), part.begin(), part.end());
  }
  return figures;
}

}  // namespace pelage

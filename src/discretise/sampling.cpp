#include "discretise/sampling.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "linalg/conjugate_gradient.h"
#include "shape/loop_subdivision.h"
#include "shape/normals.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Vector coordinate(const std::vector<Point>& points, std::size_t k) {
  Vector v(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) v[static_cast<Eigen::Index>(i)] = points[i][k];
  return v;
}

std::vector<Point> apply_to_points(const SparseMatrix& a, const std::vector<Point>& points) {
  std::vector<Point> result(at(a.rows()), Point{});
  parallel_for(result.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      for (auto k = a.pattern->start[r]; k < a.pattern->start[r + 1]; ++k)
        for (std::size_t d = 0; d < 3; ++d) result[r][d] += a.value[at(k)] * points[at(a.pattern->column[at(k)])][d];
  });
  return result;
}

/// By the quadrature.
std::vector<double> element_areas(const Discretisation& d, const std::vector<Point>& control) {
  const QuadratureGeometry g = quadrature_geometry(d, control);
  std::vector<double> areas(d.elements(), 0.0);
  for (std::size_t e = 0; e < d.elements(); ++e)
    for (auto q = d.first_point[e]; q < d.first_point[e + 1]; ++q) areas[e] += g.weight[at(q)];
  return areas;
}

/// A third of the area of the triangles around each vertex.
Vector area_share(const Discretisation& d, const std::vector<double>& area) {
  Vector share = Vector::Zero(d.unknowns);
  for (std::size_t e = 0; e < d.elements(); ++e)
    for (Index v : d.topology->triangles[e]) share[v] += area[e] / 3;
  return share;
}

/// Vertices without triangles have no area; any positive weight will do, as nothing else acts on them.
void give_isolated_vertices_weight(Vector& weight) {
  for (double& w : weight)
    if (!(w > 0)) w = 1;
}

Vector vertex_weights(const Discretisation& d, const std::vector<double>& area, const SparseMatrix& test,
                      const SparseMatrix& mass) {
  const Vector ones = Vector::Ones(d.unknowns);
  const Vector integral = mass * ones;
  const Vector share = area_share(d, area);
  Vector weight = d.nodal ? integral : solve_general(test, integral);
  weight = weight.cwiseMax(0.1 * share);
  weight *= integral.sum() / weight.sum();
  give_isolated_vertices_weight(weight);
  return weight;
}

}  // namespace

std::vector<Point> limit_positions(const Discretisation& d, const std::vector<Point>& control) {
  return apply_to_points(d.values, control);
}

std::vector<Point> limit_normals(const Discretisation& d, const std::vector<Point>& control) {
  if (d.tangent1.value.empty()) return vertex_normals(d.topology->triangles, control);
  if (d.topology->creases.any()) return loop_limit_normals(*d.topology, control);
  std::vector<Point> normal = apply_to_points(d.tangent1, control);
  const std::vector<Point> other = apply_to_points(d.tangent2, control);
  for (std::size_t i = 0; i < normal.size(); ++i) normal[i] = unit(cross(normal[i], other[i]));
  return normal;
}

Sampling vertex_sampling(const Discretisation& d, const std::vector<Point>& control, const SparseMatrix& mass) {
  return vertex_sampling(d, control, mass, transpose(d.values), element_areas(d, control));
}

Sampling vertex_sampling(const Discretisation& d, const std::vector<Point>& control, const SparseMatrix& mass,
                         SparseMatrix test, const std::vector<double>& area) {
  Sampling s;
  s.values = d.values;
  s.test = std::move(test);
  s.weight = vertex_weights(d, area, s.test, mass);
  s.position = limit_positions(d, control);
  return s;
}

namespace {

/// Mass that vertices lack so that K_ii / L_i is at most 1.5 times what 95 % of them keep.
Vector missing_mass(const SparseMatrix& stiffness, const Vector& lumped) {
  const Vector of_stiffness = diagonal(stiffness);
  std::vector<double> ratio(at(lumped.size()));
  for (std::size_t i = 0; i < ratio.size(); ++i) ratio[i] = of_stiffness[i] / lumped[i];
  if (ratio.empty()) return {};
  const auto most = ratio.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(ratio.size() - 1));
  std::ranges::nth_element(ratio, most);
  const double limit = 1.5 * *most;
  return limit > 0 ? Vector((of_stiffness / limit - lumped).cwiseMax(0)) : Vector::Zero(lumped.size());
}

}  // namespace

Sampling blended_sampling(const Discretisation& d, const std::vector<Point>& points, const SparseMatrix& consistent,
                          const SparseMatrix& stiffness, double share) {
  Sampling s;
  s.values = d.values;
  const Vector lumped = consistent * Vector::Ones(d.unknowns);
  s.weight = lumped;
  give_isolated_vertices_weight(s.weight);
  s.weight += missing_mass(stiffness, s.weight);
  s.position = points;
  s.test = consistent;
  const SparsePattern& pattern = *s.test.pattern;
  parallel_for(at(pattern.rows), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (auto k = at(pattern.start[i]); k < at(pattern.start[i + 1]); ++k) {
        const Index j = pattern.column[k];
        const double beside = share * s.test.value[k];  // the diagonal holds what makes the row sum the weight
        s.test.value[k] = (at(j) == i ? s.weight[j] - share * lumped[j] + beside : beside) / s.weight[j];
      }
  });
  return s;
}

Sampling quadrature_sampling(const Discretisation& d, const std::vector<Point>& control) {
  QuadratureGeometry g = quadrature_geometry(d, control);
  Sampling s;
  s.values = quadrature_values(d);
  s.test = transpose(s.values);
  s.weight = Eigen::Map<const Vector>(g.weight.data(), static_cast<Eigen::Index>(g.weight.size()));
  s.position = std::move(g.position);
  return s;
}

SparseMatrix sampled_mass(const Sampling& s, const Vector& weight,
                          const std::shared_ptr<const SparsePattern>& pattern) {
  SparseMatrix mass = zeros(pattern);
  const SparsePattern& samples_of = *s.test.pattern;
  const SparsePattern& functions_of = *s.values.pattern;
  parallel_for(at(pattern->rows), [&](std::size_t begin, std::size_t end) {
    // Where in row i a column is; of the columns of other rows it knows nothing.
    const std::unique_ptr<std::int64_t[]> place(new std::int64_t[at(pattern->columns)]);
    for (std::size_t i = begin; i < end; ++i) {
      for (auto k = pattern->start[i]; k < pattern->start[i + 1]; ++k) place[at(pattern->column[at(k)])] = k;
      for (auto k = samples_of.start[i]; k < samples_of.start[i + 1]; ++k) {
        const auto sample = at(samples_of.column[at(k)]);
        const double factor = s.test.value[at(k)] * weight[static_cast<Eigen::Index>(sample)];
        for (auto j = functions_of.start[sample]; j < functions_of.start[sample + 1]; ++j)
          mass.value[at(place[at(functions_of.column[at(j)])])] += factor * s.values.value[at(j)];
      }
    }
  });
  return mass;
}

Vector load(const Sampling& s, const Vector& f) { return s.test * Vector(s.weight.cwiseProduct(f)); }

bool unknowns_are_samples(const Sampling& s) {
  if (!s.values.pattern) return true;
  const SparsePattern& p = *s.values.pattern;
  for (std::int32_t i = 0; i < p.rows; ++i)
    if (p.start[at(i) + 1] != i + 1 || p.column[at(i)] != i || s.values.value[at(i)] != 1) return false;
  return p.rows == p.columns;
}

Vector coefficients_from_samples(const Sampling& s, const SparseMatrix& mass, const Vector& samples) {
  if (unknowns_are_samples(s)) return samples;
  return solve_spd(mass, load(s, samples), {.tolerance = 1e-13});
}

std::vector<Point> interpolating_control(const Discretisation& d, const std::vector<Point>& positions) {
  std::vector<Point> control(positions.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector x = solve_general(d.values, coordinate(positions, k));
    for (std::size_t i = 0; i < control.size(); ++i) control[i][k] = x[static_cast<Eigen::Index>(i)];
  }
  return control;
}

}  // namespace pelage

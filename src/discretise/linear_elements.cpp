#include <limits>

#include "discretise/method.h"
#include "discretise/surface_space.h"

namespace pelage {

namespace {

ElementClass linear_element() {
  ElementClass element;
  element.place = {{0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  element.weight = Vector::Constant(3, 1.0 / 6);
  element.value.resize(3, 3);
  for (Eigen::Index q = 0; q < 3; ++q) {
    const auto [v, w] = element.place[static_cast<std::size_t>(q)];
    element.value.row(q) << 1 - v - w, v, w;
  }
  element.dv = Eigen::RowVector3d(-1, 1, 0).replicate(3, 1);
  element.dw = Eigen::RowVector3d(-1, 0, 1).replicate(3, 1);
  return element;
}

class LinearBasis final : public ElementBasis {
 public:
  RowMatrix at(std::size_t, double v, double w) const override {
    RowMatrix jet(3, 3);
    jet << 1 - v - w, v, w, -1, 1, 0, -1, 0, 1;
    return jet;
  }
};

SparseMatrix identity(Index n) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  pattern->column.reserve(static_cast<std::size_t>(n));
  pattern->start.reserve(static_cast<std::size_t>(n) + 1);
  for (Index i = 0; i < n; ++i) {
    pattern->column.push_back(i);
    pattern->start.push_back(i + 1);
  }
  return {std::move(pattern), std::vector<double>(static_cast<std::size_t>(n), 1.0)};
}

}  // namespace

Discretisation linear_discretisation(std::shared_ptr<const Topology> shared) {
  const Topology& topology = *shared;
  Discretisation d;
  d.unknowns = topology.vertex_count;
  d.nodal = true;
  d.classes.push_back(linear_element());
  d.element_class.assign(topology.triangles.size(), 0);
  d.first_function.resize(topology.triangles.size() + 1);
  for (std::size_t f = 0; f <= topology.triangles.size(); ++f) d.first_function[f] = static_cast<std::int64_t>(3 * f);
  d.first_point = d.first_function;
  d.function.reserve(3 * topology.triangles.size());
  for (const Triangle& t : topology.triangles) d.function.insert(d.function.end(), t.begin(), t.end());
  d.values = identity(d.unknowns);
  d.basis = std::make_shared<const LinearBasis>();
  d.topology = std::move(shared);
  return d;
}

Discretisation linear_discretisation(Topology topology) {
  return linear_discretisation(std::make_shared<const Topology>(std::move(topology)));
}

namespace {

constexpr int rings_of_a_basis_function = 2;  // one would do, but a mask shall cut the same with every method

std::shared_ptr<const Space> linear_space(std::shared_ptr<const Topology> topology, std::vector<Point> control) {
  return surface_space(linear_discretisation(std::move(topology)), std::move(control), rings_of_a_basis_function);
}

/// Of the mass matrix: see blended_sampling.
constexpr double consistent_share = 0.5;

std::shared_ptr<const Space> remeshed_space(std::shared_ptr<const Topology> topology, std::vector<Point> points) {
  return surface_space(linear_discretisation(std::move(topology)), std::move(points), rings_of_a_basis_function,
                       consistent_share);
}

}  // namespace

constexpr Method remeshed_method = {.name = "remeshed",
                                    .summary = "fast, default",
                                    .refine = loop_refine,
                                    .smooth = true,
                                    .interpolate = loop_interpolation,
                                    .make_space = remeshed_space,
                                    .own_mesh = true,
                                    .edges = 5.0 / 3,
                                    .max_valence = max_loop_valence,
                                    .safe_anisotropy = 3.5,
                                    .memory = {900, 100}};

constexpr Method linear_method = {.name = "linear",
                                  .summary = "on the flat triangles of the shape",
                                  .make_space = linear_space,
                                  .safe_anisotropy = 2,
                                  .memory = {700, 100}};

}  // namespace pelage

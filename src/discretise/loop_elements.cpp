#include <algorithm>
#include <utility>

#include "discretise/discretisation.h"
#include "discretise/loop_patch.h"
#include "discretise/method.h"
#include "discretise/surface_space.h"
#include "pelage/error.h"
#include "shape/loop_subdivision.h"

namespace pelage {

namespace {

struct QuadraturePoint {
  double v, w, weight;
};

/// Six points, exact for polynomials of degree four (Strang, Fix 1973; digits of Dunavant 1985). The weights sum to
/// 1/2.
std::vector<QuadraturePoint> six_point_rule() {
  constexpr double a = 0.445948490915965, weight_a = 0.223381589678011 / 2;
  constexpr double b = 0.091576213509771, weight_b = 0.109951743655322 / 2;
  std::vector<QuadraturePoint> rule;
  for (auto [x, weight] : {std::pair{a, weight_a}, std::pair{b, weight_b}})
    for (auto [v, w] : {std::pair{x, x}, std::pair{1 - 2 * x, x}, std::pair{x, 1 - 2 * x}})
      rule.push_back({v, w, weight});
  return rule;
}

/// The rule on the four children of the triangle.
std::vector<QuadraturePoint> split(const std::vector<QuadraturePoint>& rule) {
  std::vector<QuadraturePoint> fine;
  for (const QuadraturePoint& p : rule) {
    fine.push_back({p.v / 2, p.w / 2, p.weight / 4});
    fine.push_back({(1 + p.v) / 2, p.w / 2, p.weight / 4});
    fine.push_back({p.v / 2, (1 + p.w) / 2, p.weight / 4});
    fine.push_back({(1 - p.v) / 2, (1 - p.w) / 2, p.weight / 4});
  }
  return fine;
}

ElementClass tabulate(const LoopPatches& patches, Index patch_class, const LoopQuadrature& quadrature) {
  auto rule = six_point_rule();
  const int splits = patches.polynomial(patch_class) ? quadrature.regular_splits : quadrature.irregular_splits;
  for (int i = 0; i < splits; ++i) rule = split(rule);
  const auto points = static_cast<Eigen::Index>(rule.size());
  ElementClass element;
  const std::array<RowMatrix*, 6> tables = {&element.value, &element.dv,  &element.dw,
                                            &element.dvv,   &element.dvw, &element.dww};
  for (RowMatrix* table : tables) table->resize(points, patches.size(patch_class));
  element.weight.resize(points);
  for (Eigen::Index q = 0; q < points; ++q) {
    const QuadraturePoint& p = rule[static_cast<std::size_t>(q)];
    const PatchJet jet = patches.evaluate(patch_class, p.v, p.w);
    for (std::size_t k = 0; k < tables.size(); ++k) tables[k]->row(q) = jet.row(static_cast<Eigen::Index>(k));
    element.weight[q] = p.weight;
    element.place.push_back({p.v, p.w});
  }
  return element;
}

/// Stencils as a matrix with ascending columns.
SparseMatrix to_matrix(const Stencils& stencils) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = static_cast<std::int32_t>(stencils.rows());
  pattern->columns = stencils.columns;
  SparseMatrix matrix;
  std::vector<std::pair<Index, double>> row;
  for (std::size_t r = 0; r < stencils.rows(); ++r) {
    row.clear();
    for (auto k = static_cast<std::size_t>(stencils.start[r]); k < static_cast<std::size_t>(stencils.start[r + 1]); ++k)
      row.emplace_back(stencils.index[k], stencils.weight[k]);
    std::sort(row.begin(), row.end());
    for (const auto& [column, weight] : row) {
      pattern->column.push_back(column);
      matrix.value.push_back(weight);
    }
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  matrix.pattern = std::move(pattern);
  return matrix;
}

class LoopBasis final : public ElementBasis {
 public:
  LoopBasis(LoopPatches patches, std::vector<Index> patch_class)
      : patches_(std::move(patches)), patch_class_(std::move(patch_class)) {}
  RowMatrix at(std::size_t element, double v, double w) const override {
    return patches_.evaluate(patch_class_[element], v, w).topRows(3);
  }

 private:
  LoopPatches patches_;
  std::vector<Index> patch_class_;  ///< per element
};

void refuse_high_valence(const Topology& topology) {
  const Index valence = max_valence(topology);
  if (valence > max_loop_valence)
    throw Error(Fault::input, "a vertex has " + std::to_string(valence) + " edges, more than the " +
                                  std::to_string(max_loop_valence) +
                                  " that Loop elements allow; use the linear method or remesh");
}

}  // namespace

Discretisation loop_discretisation(std::shared_ptr<const Topology> shared, const LoopQuadrature& quadrature) {
  const Topology& topology = *shared;
  refuse_high_valence(topology);
  Discretisation d;
  d.unknowns = topology.vertex_count;
  d.first_function.push_back(0);
  d.first_point.push_back(0);
  d.element_class.reserve(topology.triangles.size());
  d.function.reserve(12 * topology.triangles.size());
  LoopPatches patches;
  std::vector<Index> table;  // element class of a patch class; only some patch classes occur as elements
  std::vector<Index> patch_classes;
  for (std::size_t f = 0; f < topology.triangles.size(); ++f) {
    const auto patch_class = static_cast<std::size_t>(patches.classify(topology, static_cast<Index>(f), d.function));
    patch_classes.push_back(static_cast<Index>(patch_class));
    if (table.size() < patches.class_count()) table.resize(patches.class_count(), -1);
    if (table[patch_class] < 0) {
      table[patch_class] = static_cast<Index>(d.classes.size());
      d.classes.push_back(tabulate(patches, static_cast<Index>(patch_class), quadrature));
    }
    d.element_class.push_back(table[patch_class]);
    d.first_function.push_back(static_cast<std::int64_t>(d.function.size()));
    d.first_point.push_back(d.first_point.back() + d.classes[static_cast<std::size_t>(table[patch_class])].points());
  }
  d.basis = std::make_shared<const LoopBasis>(std::move(patches), std::move(patch_classes));
  const LimitMasks masks = loop_limit_masks(topology);
  d.values = to_matrix(masks.position);
  d.tangent1 = to_matrix(masks.tangent1);
  d.tangent2 = to_matrix(masks.tangent2);
  d.topology = std::move(shared);
  return d;
}

Discretisation loop_discretisation(Topology topology, const LoopQuadrature& quadrature) {
  return loop_discretisation(std::make_shared<const Topology>(std::move(topology)), quadrature);
}

namespace {

/// Basis functions end in the triangles about the neighbours of their vertex.
constexpr int rings_of_a_basis_function = 2;

std::shared_ptr<const Space> loop_space(std::shared_ptr<const Topology> topology, std::vector<Point> control) {
  return surface_space(loop_discretisation(std::move(topology)), std::move(control), rings_of_a_basis_function);
}

}  // namespace

std::vector<Point> loop_interpolation(const Topology& topology, const std::vector<Point>& points) {
  return interpolating_control(loop_discretisation(topology), points);
}

constexpr Method loop_method = {.name = "loop",
                                .summary = "smooth, for small errors",
                                .refine = loop_refine,
                                .smooth = true,
                                .interpolate = loop_interpolation,
                                .make_space = loop_space,
                                .nodal = false,
                                .max_valence = max_loop_valence,
                                .safe_anisotropy = 32,
                                .memory = {2850, 100}};

}  // namespace pelage

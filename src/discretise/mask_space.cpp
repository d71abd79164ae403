// Diffusion by masks of three by three nodes (Witkin, Kass 1991, eqs. 4 and 7) as a Space, for comparison: sum A_ij d_i
// d_j u without the derivatives of A, which is not conservative where A varies, nor symmetric. On curved sheets it is
// their correction of the first order (section 4): A in the parameters, P A P' with the inverse P of the Jacobian in
// the tangent plane, so that A = I becomes the inverse of the metric (the print has V and its inverse exchanged); terms
// with derivatives of the metric are left out.

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "discretise/grid_space.h"
#include "discretise/method.h"
#include "pelage/error.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Grid require_sheet(const Grid& grid) {
  if (grid.dimension() != 2) throw Error(Fault::usage, "the method \"masks\" is for sheets; take \"grid\"");
  return grid;
}

std::array<Point, 3> periods(const Grid& grid) {
  if (!grid.even()) return grid.period;
  std::array<Point, 3> period{};
  for (std::size_t a = 0; a < 3; ++a) period[a][a] = grid.spacing[a] * grid.count[a];
  return period;
}

/// From tangent vectors in the world to the parameters, in which nodes are 1 apart; and the area of a cell.
struct Parameters {
  Eigen::Matrix<double, 2, 3> pull;
  double area;
};

/// Nodes are samples and quadrature points. Borders of closed axes are mirrors; their nodes have half a cell.
class MaskSpace final : public Space {
 public:
  explicit MaskSpace(const Grid& grid);

  Index unknowns() const override { return elements_.unknowns(); }
  SampledMass sampled(SampleRule) const override { return sampled_; }
  const SparseMatrix& node_values() const override { return elements_.node_values(); }
  SparseMatrix quadrature_values() const override { return elements_.node_values(); }
  SharedMatrix stiffness() const override { return stiffness_; }
  SparseMatrix weighted_mass(const std::vector<double>& c) const override;
  SparseMatrix stiffness(const std::vector<double>& c) const override {
    return stiffness_of([&](Index v) { return Tensor{c[at(v)], 0, 0, c[at(v)], 0, c[at(v)]}; });
  }
  SparseMatrix stiffness(const std::vector<Tensor>& c) const override {
    return stiffness_of([&](Index v) { return c[at(v)]; });
  }
  Vector gradient_product(SampleRule, const Vector& u, const Vector& v) const override;
  ElementPoint element_point(Index face, double v, double w) const override {
    return elements_.element_point(face, v, w);
  }
  PlaceGeometry geometry(SampleRule, bool with_curvature) const override {
    return elements_.geometry(SampleRule::vertices, with_curvature);
  }
  std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const override { return at_nodes; }
  std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const override;
  std::vector<char> interior(std::vector<char> nodes) const override { return elements_.interior(std::move(nodes)); }
  SpaceBorder border(const std::string& side) const override { return elements_.border(side); }
  const std::vector<Point>& control() const override { return elements_.control(); }
  std::shared_ptr<const Space> moved(std::vector<Point>) const override {
    throw Error(Fault::usage, "the method \"masks\" is for grids at rest; take \"grid\"");
  }

 private:
  /// Entries of a row: the nodes (-1, -1), (0, -1) ... (1, 1) from node v.
  using Row = std::array<std::pair<Index, double>, 9>;
  /// - A_ij d_i d_j.
  Row mask(Index v, const Tensor& a) const;
  template <class Coefficient>
  SparseMatrix stiffness_of(const Coefficient& coefficient) const;
  std::shared_ptr<const SparsePattern> make_pattern() const;
  Index neighbour(Index v, Index dx, Index dy) const;
  double area(Index v) const;
  Parameters parameters_at(Index v) const;
  const Parameters& parameters(Index v) const { return parameters_[parameters_.size() == 1 ? 0 : at(v)]; }

  Grid grid_;
  std::array<Point, 3> period_;  ///< from the first node to behind the last
  GridSpace elements_;           ///< for all but derivatives and mass
  std::shared_ptr<const SparsePattern> pattern_;
  std::vector<Parameters> parameters_;  ///< per node; one for all of even sheets
  SharedMatrix stiffness_;
  SampledMass sampled_;
};

MaskSpace::MaskSpace(const Grid& grid)
    : grid_(require_sheet(grid)), period_(periods(grid)), elements_(grid), pattern_(make_pattern()) {
  grid_.attributes.clear();
  for (Index v = 0; v < (grid_.even() ? 1 : unknowns()); ++v) parameters_.push_back(parameters_at(v));
  stiffness_ = std::make_shared<const SparseMatrix>(stiffness(std::vector<double>(at(unknowns()), 1.0)));
  Sampling s{node_values(), node_values(), Vector(unknowns()), control()};
  for (Index v = 0; v < unknowns(); ++v) s.weight[v] = area(v);
  sampled_ = {std::make_shared<const Sampling>(std::move(s)),
              std::make_shared<const SparseMatrix>(weighted_mass(std::vector<double>(at(unknowns()), 1.0)))};
}

/// Behind the border of a closed axis lies what is before it.
Index MaskSpace::neighbour(Index v, Index dx, Index dy) const {
  std::array<Index, 2> place = {v % grid_.count[0] + dx, v / grid_.count[0] + dy};
  for (std::size_t a = 0; a < 2; ++a) {
    const Index n = grid_.count[a];
    if (place[a] < 0) place[a] = grid_.periodic[a] ? n - 1 : 1;
    if (place[a] >= n) place[a] = grid_.periodic[a] ? 0 : n - 2;
  }
  return grid_.node(place[0], place[1], 0);
}

/// By central differences, at borders by the difference there is.
Parameters MaskSpace::parameters_at(Index v) const {
  const std::array<Index, 2> place = {v % grid_.count[0], v / grid_.count[0]};
  Eigen::Matrix<double, 3, 2> jacobian;
  for (std::size_t a = 0; a < 2; ++a) {
    const Index n = grid_.count[a], stride = a == 0 ? 1 : grid_.count[0];
    Eigen::Vector3d difference = Eigen::Vector3d::Zero();
    double steps = 0;
    for (const Index step : {-1, 1}) {
      const Index to = place[a] + step;
      const bool around = to < 0 || to >= n;
      if (around && !grid_.periodic[a]) continue;
      const Point p = grid_.point(v + (around ? -step * (n - 1) : step) * stride);
      Eigen::Vector3d x(p[0], p[1], p[2]);
      if (around) x += step * Eigen::Vector3d::Map(period_[a].data());
      difference += step * x;
      ++steps;
    }
    if (steps < 2) {
      const Point p = grid_.point(v);
      difference += (place[a] == 0 ? -1 : 1) * Eigen::Vector3d(p[0], p[1], p[2]);
      steps = 1;
    }
    jacobian.col(static_cast<Eigen::Index>(a)) = difference / steps;
  }
  const Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
  return {metric.inverse() * jacobian.transpose(), std::sqrt(metric.determinant())};
}

double MaskSpace::area(Index v) const {
  const std::array<Index, 2> place = {v % grid_.count[0], v / grid_.count[0]};
  double area = parameters(v).area;
  for (std::size_t a = 0; a < 2; ++a)
    if (!grid_.periodic[a] && (place[a] == 0 || place[a] + 1 == grid_.count[a])) area /= 2;
  return area;
}

MaskSpace::Row MaskSpace::mask(Index v, const Tensor& a) const {
  const Eigen::Matrix2d in = parameters(v).pull * matrix_of(a) * parameters(v).pull.transpose();
  const double x = in(0, 0), y = in(1, 1), corner = in(0, 1) / 2;
  const std::array<double, 9> weight = {-corner, -y, corner, -x, 2 * (x + y), -x, corner, -y, -corner};
  Row row;
  for (std::size_t k = 0; k < 9; ++k)
    row[k] = {neighbour(v, static_cast<Index>(k % 3) - 1, static_cast<Index>(k / 3) - 1), weight[k]};
  return row;
}

std::shared_ptr<const SparsePattern> MaskSpace::make_pattern() const {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = unknowns();
  for (Index v = 0; v < unknowns(); ++v) {
    std::array<Index, 9> row;
    for (std::size_t k = 0; k < 9; ++k)
      row[k] = neighbour(v, static_cast<Index>(k % 3) - 1, static_cast<Index>(k / 3) - 1);
    std::ranges::sort(row);
    for (std::size_t k = 0; k < row.size(); ++k)
      if (k == 0 || row[k] != row[k - 1]) pattern->column.push_back(row[k]);
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  return pattern;
}

template <class Coefficient>
SparseMatrix MaskSpace::stiffness_of(const Coefficient& coefficient) const {
  SparseMatrix k = zeros(pattern_);
  parallel_for(at(unknowns()), [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<Index>(begin); v < static_cast<Index>(end); ++v)
      for (const auto& [column, weight] : mask(v, coefficient(v)))
        k.value[at(pattern_->find(v, column))] += area(v) * weight;
  });
  return k;
}

SparseMatrix MaskSpace::weighted_mass(const std::vector<double>& c) const {
  SparseMatrix mass = zeros(pattern_);
  for (Index v = 0; v < unknowns(); ++v) mass.value[at(pattern_->find(v, v))] = c[at(v)] * area(v);
  return mass;
}

/// By central differences.
Vector MaskSpace::gradient_product(SampleRule, const Vector& u, const Vector& v) const {
  Vector product(unknowns());
  for (Index k = 0; k < unknowns(); ++k) {
    const auto slopes = [&](const Vector& f) {
      const auto slope = [&](Index dx, Index dy) { return (f[neighbour(k, dx, dy)] - f[neighbour(k, -dx, -dy)]) / 2; };
      return Eigen::Vector2d(slope(1, 0), slope(0, 1));
    };
    const auto& pull = parameters(k).pull;
    product[k] = slopes(u).dot(pull * pull.transpose() * slopes(v));
  }
  return product;
}

std::vector<Tensor> MaskSpace::tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const {
  std::vector<Tensor> result(at(unknowns()));
  const std::vector<Point> normal = elements_.geometry(SampleRule::vertices, false).normal;
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = surface_tensor(lines[lines.size() == 1 ? 0 : v], normal[v], rates.theta[v], rates.a1[v], rates.a2[v]);
  return result;
}

std::shared_ptr<const Space> mask_space(const NodeShape& nodes) {
  return std::make_shared<const MaskSpace>(std::get<Grid>(nodes));
}

bool is_grid(const NodeShape& nodes) { return std::holds_alternative<Grid>(nodes); }

}  // namespace

constexpr Method mask_method = {.name = "masks",
                                .summary = "on sheets, as Witkin and Kass did it",
                                .make_node_space = mask_space,
                                .fits = is_grid,
                                .symmetric = false,
                                .memory = {130, 55}};

}  // namespace pelage

#include "discretise/cell_space.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "pelage/error.h"
#include "shape/cell_values.h"

namespace pelage {

namespace {

constexpr std::size_t chunk = 256;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

template <class Body>
void for_each_cell(std::size_t n, const Body& body) {
  parallel_for(
      n,
      [&](std::size_t begin, std::size_t end) {
        CellShapes::Scratch scratch;
        for (std::size_t i = begin; i < end; ++i) body(i, scratch);
      },
      chunk);
}

SparseMatrix identity(Index n) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  pattern->column.resize(at(n));
  std::iota(pattern->column.begin(), pattern->column.end(), 0);
  pattern->start.resize(at(n) + 1);
  std::iota(pattern->start.begin(), pattern->start.end(), 0);
  return {std::move(pattern), std::vector<double>(at(n), 1.0)};
}

/// What may flow between cells with these coefficients: nothing into one where nothing diffuses.
double harmonic(double a, double b) { return a + b > 0 ? 2 * a * b / (a + b) : 0; }

}  // namespace

CellSpace::CellSpace(Cells cells, Coefficients coefficients)
    : cells_(std::move(cells)), coefficients_(coefficients), shapes_(cells_, cells_.stretch), area_(cells_.nodes()) {
  const std::size_t n = cells_.nodes();
  std::vector<PlaneCell> shapes(n);
  for_each_cell(n, [&](std::size_t i, CellShapes::Scratch& scratch) {
    shapes[i] = shapes_.shape(i, scratch);
    area_[i] = shapes[i].area();
  });
  lay_out(shapes);
  const double mean = std::accumulate(area_.begin(), area_.end(), 0.0) / static_cast<double>(n);
  if (coefficients == Coefficients::turk) std::ranges::fill(area_, mean);
  sides_.assign(pattern_->nonzeros(), 0.0);
  for (std::size_t i = 0; i < n; ++i) take_sides(i, shapes[i], 1, sides_);
  if (coefficients == Coefficients::turk) scale_to_world();
  stiffness_ = std::make_shared<const SparseMatrix>(joined(sides_, [](Index, Index) { return 1.0; }));
  Sampling s{identity(unknowns()), identity(unknowns()), Vector::Map(area_.data(), unknowns()), cells_.points};
  sampled_ = {std::make_shared<const Sampling>(std::move(s)),
              std::make_shared<const SparseMatrix>(weighted_mass(std::vector<double>(n, 1.0)))};
}

/// Rows of the cells behind the sides of either, and where cells may be stretched also of those within reach of that.
void CellSpace::lay_out(const std::vector<PlaneCell>& shapes) {
  const std::size_t n = shapes.size();
  std::vector<std::vector<Index>> row(n);
  const double reach = cells_.stretch > 1 ? 0.9 * cells_.radius * std::sqrt(cells_.stretch) : 0;
  for_each_cell(n, [&](std::size_t i, CellShapes::Scratch& scratch) {
    row[i].push_back(static_cast<Index>(i));
    for (const PlaneCell::Beyond& b : shapes[i].beyond)
      if (b.cell >= 0) row[i].push_back(b.cell);
    if (!(reach > 0)) return;
    shapes_.neighbours().find(i, reach, scratch.found);
    for (const CellNeighbour& found : scratch.found) row[i].push_back(found.cell);
  });
  for (std::size_t i = 0; i < n; ++i)
    for (const PlaneCell::Beyond& b : shapes[i].beyond)
      if (b.cell >= 0) row[at(b.cell)].push_back(static_cast<Index>(i));
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = unknowns();
  for (std::vector<Index>& r : row) {
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    pattern->column.insert(pattern->column.end(), r.begin(), r.end());
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  pattern_ = pattern;
  mirror_.resize(pattern->nonzeros());
  way_.resize(pattern->nonzeros());
  for_each_cell(n, [&](std::size_t i, CellShapes::Scratch&) {
    const TangentFrame frame(cells_.normals[i]);
    for (auto k = at(pattern->start[i]); k < at(pattern->start[i + 1]); ++k) {
      const auto j = at(pattern->column[k]);
      mirror_[k] = pattern->find(static_cast<Index>(j), static_cast<Index>(i));
      way_[k] =
          frame.in(unfolded(difference(cells_.points[j], cells_.points[i]), cells_.normals[i], cells_.normals[j]).way);
    }
  });
}

/// Turk counts lengths in cells; here the Laplacian of a square is right in the mean.
void CellSpace::scale_to_world() {
  double sum = 0;
  for (std::size_t k = 0; k < sides_.size(); ++k)
    sum += sides_[k] * (way_[k][0] * way_[k][0] + way_[k][1] * way_[k][1]);
  scale_ = 4 * std::accumulate(area_.begin(), area_.end(), 0.0) / sum;
  for (double& side : sides_) side *= scale_;
}

/// Sides of a cell whose neighbours were moved are longer and nearer in the same proportion: only their ratio counts.
void CellSpace::take_sides(std::size_t cell, const PlaneCell& shape, double rate, Sides& sides) const {
  double sum = 0;
  for (std::size_t s = 0; s < shape.corner.size(); ++s)
    if (shape.beyond[s].cell >= 0) sum += shape.side_length(s);
  for (std::size_t s = 0; s < shape.corner.size(); ++s) {
    if (shape.beyond[s].cell < 0) continue;
    const std::int64_t k = pattern_->find(static_cast<Index>(cell), shape.beyond[s].cell);
    if (k < 0) continue;
    const double length = shape.side_length(s);
    sides[at(k)] +=
        rate * (coefficients_ == Coefficients::turk ? scale_ * 4 * length / sum : length / shape.beyond[s].distance);
  }
}

/// `between`: the coefficient between two cells.
template <class Between>
SparseMatrix CellSpace::joined(const Sides& sides, const Between& between) const {
  SparseMatrix k = zeros(pattern_);
  const bool turk = coefficients_ == Coefficients::turk;
  for_each_cell(cells_.nodes(), [&](std::size_t i, CellShapes::Scratch&) {
    double sum = 0;
    std::size_t own = 0;
    for (auto e = at(pattern_->start[i]); e < at(pattern_->start[i + 1]); ++e) {
      const Index j = pattern_->column[e];
      if (at(j) == i) {
        own = e;
        continue;
      }
      const double flow =
          (turk ? sides[e] : (sides[e] + sides[at(mirror_[e])]) / 2) * between(static_cast<Index>(i), j);
      k.value[e] = -flow;
      sum += flow;
    }
    k.value[own] = sum;
  });
  return k;
}

SparseMatrix CellSpace::weighted_mass(const std::vector<double>& c) const {
  SparseMatrix mass = zeros(pattern_);
  for (Index v = 0; v < unknowns(); ++v) mass.value[at(pattern_->find(v, v))] = c[at(v)] * area_[at(v)];
  return mass;
}

SparseMatrix CellSpace::stiffness(const std::vector<double>& c) const {
  return joined(sides_, [&](Index i, Index j) { return harmonic(c[at(i)], c[at(j)]); });
}

/// With T = rate C^-2 and det C = 1.
PlaneCell CellSpace::contracted(std::size_t cell, const Tensor& t, CellShapes::Scratch& scratch, double& rate) const {
  const TangentFrame frame(cells_.normals[cell]);
  Eigen::Matrix<double, 3, 2> axes;
  for (Eigen::Index k = 0; k < 3; ++k) axes(k, 0) = frame.e[at(k)], axes(k, 1) = frame.f[at(k)];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> s(axes.transpose() * matrix_of(t) * axes);
  constexpr double least_share = 1e-3;  // cells do not become longer without end
  Eigen::Vector2d value = s.eigenvalues().cwiseMax(0);
  value[0] = std::max(value[0], least_share * value[1]);
  rate = std::sqrt(value[0] * value[1]);
  if (!(rate > 0)) return {};
  const Eigen::Vector2d by = (rate / value.array()).sqrt();
  const Eigen::Matrix2d c = s.eigenvectors() * by.asDiagonal() * s.eigenvectors().transpose();
  return shapes_.contracted(cell, {c(0, 0), c(0, 1), c(1, 1)}, scratch);
}

SparseMatrix CellSpace::stiffness(const std::vector<Tensor>& t) const {
  Sides sides(pattern_->nonzeros(), 0.0);
  std::vector<double> rate(cells_.nodes());
  for_each_cell(cells_.nodes(), [&](std::size_t i, CellShapes::Scratch& scratch) {
    const PlaneCell shape = contracted(i, t[i], scratch, rate[i]);
    take_sides(i, shape, rate[i], sides);
  });
  // Nothing flows into what does not diffuse.
  return joined(sides, [&](Index i, Index j) { return rate[at(i)] > 0 && rate[at(j)] > 0 ? 1.0 : 0.0; });
}

/// Sum of the ways' products with themselves, weighted with the sides.
Eigen::Matrix2d CellSpace::moments(std::size_t cell) const {
  Eigen::Matrix2d m = Eigen::Matrix2d::Zero();
  for (auto k = at(pattern_->start[cell]); k < at(pattern_->start[cell + 1]); ++k) {
    const Eigen::Vector2d q(way_[k][0], way_[k][1]);
    m += sides_[k] * q * q.transpose();
  }
  return m;
}

namespace {

/// 0 along a direction of which neighbours say nothing.
Eigen::Matrix2d pseudo_inverse(const Eigen::Matrix2d& m) {
  constexpr double least_share = 1e-6;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> s(m);
  const double least = least_share * s.eigenvalues()[1];
  const Eigen::Vector2d inverse =
      s.eigenvalues().unaryExpr([least](double x) { return x > least && x > 0 ? 1 / x : 0.0; });
  return s.eigenvectors() * inverse.asDiagonal() * s.eigenvectors().transpose();
}

}  // namespace

std::vector<Eigen::Vector2d> CellSpace::slopes(const Vector& u) const {
  std::vector<Eigen::Vector2d> result(cells_.nodes());
  for_each_cell(result.size(), [&](std::size_t i, CellShapes::Scratch&) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (auto k = at(pattern_->start[i]); k < at(pattern_->start[i + 1]); ++k)
      sum += sides_[k] * (u[pattern_->column[k]] - u[static_cast<Index>(i)]) * Eigen::Vector2d(way_[k][0], way_[k][1]);
    result[i] = pseudo_inverse(moments(i)) * sum;
  });
  return result;
}

std::vector<Point> CellSpace::gradients(const Vector& u) const {
  std::vector<Point> result;
  for (const Eigen::Vector2d& slope : slopes(u))
    result.push_back(TangentFrame(cells_.normals[result.size()]).out({slope[0], slope[1]}));
  return result;
}

Vector CellSpace::gradient_product(SampleRule, const Vector& u, const Vector& v) const {
  const std::vector<Eigen::Vector2d> a = slopes(u), b = slopes(v);
  Vector product(unknowns());
  for (std::size_t i = 0; i < a.size(); ++i) product[static_cast<Index>(i)] = a[i].dot(b[i]);
  return product;
}

ElementPoint CellSpace::element_point(Index face, double v, double w) const {
  const Triangle& t = cells_.on->triangles.at(at(face));
  const auto corner = [&](std::size_t k) { return cells_.on->points[at(t[k])]; };
  const Point e = difference(corner(1), corner(0)), f = difference(corner(2), corner(0));
  Point place = corner(0);
  for (std::size_t k = 0; k < 3; ++k) place[k] += v * e[k] + w * f[k];
  std::vector<CellValues::Weight> weights;
  CellValues(cells_).at(place, unit(cross(e, f)), weights);
  ElementPoint point{{}, RowMatrix::Zero(3, std::ssize(weights))};
  for (const CellValues::Weight& weight : weights) {
    const auto column = std::ssize(point.function);
    point.function.push_back(weight.cell);
    point.jet(0, column) = weight.share;
    point.jet(1, column) = dot(weight.slope, e);
    point.jet(2, column) = dot(weight.slope, f);
  }
  return point;
}

namespace {

/// The change of the normals along the ways, as a tensor in space.
Tensor in_space(const Eigen::Matrix2d& m, const TangentFrame& frame) {
  const Eigen::Vector3d e(frame.e[0], frame.e[1], frame.e[2]), f(frame.f[0], frame.f[1], frame.f[2]);
  const Eigen::Matrix3d s = m(0, 0) * e * e.transpose() + m(1, 1) * f * f.transpose() +
                            (m(0, 1) + m(1, 0)) / 2 * (e * f.transpose() + f * e.transpose());
  return {s(0, 0), s(0, 1), s(0, 2), s(1, 1), s(1, 2), s(2, 2)};
}

}  // namespace

/// By least squares; of flat polygons the normals are those of their means over neighbours.
std::vector<Tensor> CellSpace::curvature() const {
  const std::size_t n = cells_.nodes();
  std::vector<Point> normal(n);
  std::vector<Tensor> result(n);
  for_each_cell(n, [&](std::size_t i, CellShapes::Scratch&) {
    Point sum{};
    for (auto k = at(pattern_->start[i]); k < at(pattern_->start[i + 1]); ++k)
      for (std::size_t d = 0; d < 3; ++d) sum[d] += cells_.normals[at(pattern_->column[k])][d];
    normal[i] = unit(sum);
  });
  for_each_cell(n, [&](std::size_t i, CellShapes::Scratch&) {
    const TangentFrame frame(cells_.normals[i]);
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (auto k = at(pattern_->start[i]); k < at(pattern_->start[i + 1]); ++k) {
      const PlanePoint change = frame.in(difference(normal[at(pattern_->column[k])], normal[i]));
      sum += sides_[k] * Eigen::Vector2d(change[0], change[1]) * Eigen::RowVector2d(way_[k][0], way_[k][1]);
    }
    result[i] = in_space(sum * pseudo_inverse(moments(i)), frame);
  });
  return result;
}

PlaceGeometry CellSpace::geometry(SampleRule, bool with_curvature) const {
  PlaceGeometry places{cells_.points, cells_.normals, {}};
  if (with_curvature) places.curvature = principal_curvatures(curvature(), places.normal);
  return places;
}

std::vector<Tensor> CellSpace::tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const {
  std::vector<Tensor> result(cells_.nodes());
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] =
        surface_tensor(lines[lines.size() == 1 ? 0 : v], cells_.normals[v], rates.theta[v], rates.a1[v], rates.a2[v]);
  return result;
}

std::vector<char> CellSpace::interior(std::vector<char> nodes) const {
  std::vector<char> inner = nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (auto k = at(pattern_->start[i]); k < at(pattern_->start[i + 1]); ++k)
      if (!nodes[at(pattern_->column[k])]) inner[i] = 0;
  return inner;
}

std::shared_ptr<const Space> CellSpace::moved(std::vector<Point>) const {
  throw Error(Fault::usage, "cells stay where they are: leave fairing and growth out");
}

namespace {

bool are_cells(const NodeShape& nodes) { return std::holds_alternative<Cells>(nodes); }

std::shared_ptr<const Space> volumes_on(const NodeShape& nodes) {
  return std::make_shared<const CellSpace>(std::get<Cells>(nodes));
}
std::shared_ptr<const Space> turk_on(const NodeShape& nodes) {
  return std::make_shared<const CellSpace>(std::get<Cells>(nodes), CellSpace::Coefficients::turk);
}

}  // namespace

constexpr Method cell_method = {.name = "cells",
                                .summary = "on points scattered over any polygons or point clouds",
                                .edges = 5.0 / 3,
                                .make_node_space = volumes_on,
                                .fits = are_cells};

constexpr Method turk_method = {.name = "turk-cells",
                                .summary = "the same with the coefficients of Turk",
                                .edges = 5.0 / 3,
                                .make_node_space = turk_on,
                                .fits = are_cells,
                                .symmetric = false};

}  // namespace pelage

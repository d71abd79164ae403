#include "discretise/grid_space.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "discretise/method.h"
#include "pelage/error.h"
#include "shape/atlas.h"
#include "shape/grid.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Eigen::Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }
Point point(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }

Tensor tensor(const Eigen::Matrix3d& m) { return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}; }

SparseMatrix identity(Index n) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  pattern->column.resize(at(n));
  pattern->start.resize(at(n) + 1);
  for (Index i = 0; i < n; ++i) {
    pattern->column[at(i)] = i;
    pattern->start[at(i) + 1] = i + 1;
  }
  return {std::move(pattern), std::vector<double>(at(n), 1.0)};
}

std::optional<Lattice> lattice_of(const Grid& grid) {
  if (!grid.even()) return {};
  Lattice l;
  for (std::size_t a = 0; a < at(grid.dimension()); ++a)
    l.count[a] = at(grid.count[a]), l.periodic[a] = grid.periodic[a], l.spacing[a] = grid.spacing[a];
  return l;
}

}  // namespace

namespace {

/// All nodes of an atlas, as if they were a row.
Grid row_of_nodes(const Atlas& atlas) {
  Grid row;
  row.points = mesh_of(atlas).points;
  row.count = {atlas.nodes, 1, 1};
  return row;
}

}  // namespace

GridSpace::GridSpace(Grid grid) : GridSpace(grid, grid.dimension(), std::make_shared<SharedConnectivity>()) {}

GridSpace::GridSpace(const Atlas& atlas) : GridSpace(row_of_nodes(atlas), 2, std::make_shared<SharedConnectivity>()) {
  std::call_once(connectivity_->once,
                 [&] { connectivity_->made = std::make_unique<const Connectivity>(grid_cells(atlas)); });
}

GridSpace::GridSpace(Grid grid, int dimension, std::shared_ptr<SharedConnectivity> connectivity)
    : grid_(std::move(grid)),
      dimension_(dimension),
      rule_(dimension, quadrature_xi2(grid_)),
      lattice_(lattice_of(grid_)),
      connectivity_(std::move(connectivity)) {
  grid_.attributes.clear();
  require_sound(grid_);
  if (grid_.even()) fill_cell_points(rule_, even_cell(grid_.spacing), even_.emplace());
}

const GridSpace::Connectivity& GridSpace::connectivity() const {
  std::call_once(connectivity_->once,
                 [&] { connectivity_->made = std::make_unique<const Connectivity>(grid_cells(grid_)); });
  return *connectivity_->made;
}

const CellPoints& GridSpace::points_of(std::size_t cell, CellPoints& scratch) const {
  if (even_) return *even_;
  fill_cell_points(rule_, cell_corners(cells(), cell, grid_.points), scratch);
  return scratch;
}

template <class Body>
void GridSpace::for_each_cell(const Body& body) const {
  parallel_for(
      cells().count(),
      [&](std::size_t begin, std::size_t end) {
        CellPoints scratch;
        for (std::size_t e = begin; e < end; ++e) body(e, points_of(e, scratch));
      },
      256);
}

namespace {

/// out += w phi_i phi_j.
void add_mass(const CellRule& rule, std::size_t q, double w, double* out) {
  const std::size_t n = at(rule.points);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) out[i * n + j] += w * (rule.value[q][i] * rule.value[q][j]);
}

/// out += w grad phi_i . c grad phi_j, with a number or a symmetric matrix c.
template <class Coefficient>
void add_stiffness(const CellRule& rule, const CellPoint& p, const Coefficient& c, double* out) {
  const std::size_t n = at(rule.points);
  for (std::size_t j = 0; j < n; ++j) {
    const Eigen::Vector3d flux = c * (p.weight * p.gradient[j]);
    for (std::size_t i = 0; i < n; ++i) out[i * n + j] += p.gradient[i].dot(flux);
  }
}

/// As it is but for rounding.
void make_symmetric(std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) out[i * n + j] = out[j * n + i];
}

}  // namespace

const GridSpace::Matrices& GridSpace::matrices() const {
  std::call_once(matrices_once_, [&] {
    auto made = connectivity().matrices.sum<2, CellPoints>(
        [&](std::size_t e, CellPoints& scratch, const std::array<double*, 2>& out) {
          const CellPoints& points = points_of(e, scratch);
          for (std::size_t q = 0; q < points_per_cell(); ++q) {
            add_mass(rule_, q, points[q].weight, out[0]);
            add_stiffness(rule_, points[q], 1.0, out[1]);
          }
          make_symmetric(points_per_cell(), out[1]);
        });
    matrices_ = {std::make_shared<const SparseMatrix>(std::move(made[0])),
                 std::make_shared<const SparseMatrix>(std::move(made[1]))};
  });
  return matrices_;
}

SharedMatrix GridSpace::stiffness() const { return matrices().stiffness; }

SparseMatrix GridSpace::weighted_mass(const std::vector<double>& c) const {
  return std::move(connectivity().matrices.sum<1, CellPoints>(
      [&](std::size_t e, CellPoints& scratch, const std::array<double*, 1>& out) {
        const CellPoints& points = points_of(e, scratch);
        for (std::size_t q = 0; q < points_per_cell(); ++q)
          add_mass(rule_, q, c[e * points_per_cell() + q] * points[q].weight, out[0]);
      })[0]);
}

template <class Coefficient>
SparseMatrix GridSpace::stiffness_of(const Coefficient& coefficient) const {
  return std::move(connectivity().matrices.sum<1, CellPoints>(
      [&](std::size_t e, CellPoints& scratch, const std::array<double*, 1>& out) {
        const CellPoints& points = points_of(e, scratch);
        for (std::size_t q = 0; q < points_per_cell(); ++q)
          add_stiffness(rule_, points[q], coefficient(e * points_per_cell() + q), out[0]);
        make_symmetric(points_per_cell(), out[0]);
      })[0]);
}

SparseMatrix GridSpace::stiffness(const std::vector<double>& c) const {
  return stiffness_of([&](std::size_t q) { return c[q]; });
}

SparseMatrix GridSpace::stiffness(const std::vector<Tensor>& c) const {
  return stiffness_of([&](std::size_t q) { return matrix_of(c[q]); });
}

/// As of linear elements with their blended mass: unknowns are samples, and test = M W^-1 with the row sums W.
Sampling GridSpace::vertex_sampling(const SparseMatrix& mass) const {
  Sampling s;
  s.values = node_values();
  s.weight = mass * Vector::Ones(unknowns());
  for (double& w : s.weight)
    if (!(w > 0)) w = 1;  // of nodes in degenerate cells alone, where nothing else acts
  s.test = mass;
  parallel_for(s.test.value.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) s.test.value[k] /= s.weight[s.test.pattern->column[k]];
  });
  s.position = positions(SampleRule::vertices);
  return s;
}

Sampling GridSpace::quadrature_sampling() const {
  Sampling s;
  s.values = quadrature_values();
  s.test = transpose(s.values);
  s.weight.resize(static_cast<Eigen::Index>(quadrature_points()));
  for_each_cell([&](std::size_t e, const CellPoints& points) {
    for (std::size_t q = 0; q < points_per_cell(); ++q)
      s.weight[static_cast<Eigen::Index>(e * points_per_cell() + q)] = points[q].weight;
  });
  s.position = positions(SampleRule::quadrature);
  return s;
}

SampledMass GridSpace::sampled(SampleRule rule) const {
  const SharedMatrix mass = matrices().mass;
  if (rule == SampleRule::vertices) {
    std::call_once(vertices_once_, [&] {
      at_vertices_ = {std::make_shared<const Sampling>(vertex_sampling(*mass)), mass};
    });
    return at_vertices_;
  }
  std::call_once(quadrature_once_, [&] {
    at_quadrature_ = {std::make_shared<const Sampling>(quadrature_sampling()), mass};
  });
  return at_quadrature_;
}

const SparseMatrix& GridSpace::node_values() const {
  std::call_once(values_once_, [&] { values_ = identity(unknowns()); });
  return values_;
}

SparseMatrix GridSpace::quadrature_values() const {
  const std::size_t n = points_per_cell();
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = static_cast<Index>(quadrature_points());
  pattern->columns = unknowns();
  pattern->start.resize(quadrature_points() + 1);
  pattern->column.resize(quadrature_points() * n);
  std::vector<double> value(pattern->column.size());
  for_each_cell([&](std::size_t e, const CellPoints&) {
    std::array<std::pair<Index, std::size_t>, 8> order;
    for (std::size_t c = 0; c < n; ++c) order[c] = {cells().corner[e * n + c], c};
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n));
    for (std::size_t q = 0; q < n; ++q)
      for (std::size_t c = 0; c < n; ++c) {
        const std::size_t k = (e * n + q) * n + c;
        pattern->column[k] = order[c].first;
        value[k] = rule_.value[q][order[c].second];
        if (c + 1 == n) pattern->start[e * n + q + 1] = static_cast<std::int64_t>(k + 1);
      }
  });
  return {std::move(pattern), std::move(value)};
}

/// Values at the nodes: means over the quadrature points around, weighted with volumes and the nodes' functions.
const std::vector<SparseMatrix>& GridSpace::mean_gradients() const {
  std::call_once(gradients_once_, [&] {
    auto sums = connectivity().matrices.sum<3, CellPoints>([&](std::size_t e, CellPoints& scratch,
                                                               const std::array<double*, 3>& out) {
      const CellPoints& points = points_of(e, scratch);
      const std::size_t n = points_per_cell();
      for (std::size_t q = 0; q < n; ++q)
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < 3; ++k)
              out[k][i * n + j] += points[q].weight * rule_.value[q][i] * points[q].gradient[j][static_cast<int>(k)];
    });
    const Vector weight = *matrices().mass * Vector::Ones(unknowns());
    for (SparseMatrix& sum : sums) {
      if (std::ranges::all_of(sum.value, [](double x) { return x == 0; })) continue;  // in a plane, or along a line
      for (Index i = 0; i < unknowns(); ++i)
        for (auto k = sum.pattern->start[at(i)]; k < sum.pattern->start[at(i) + 1]; ++k)
          if (weight[i] > 0) sum.value[at(k)] /= weight[i];
      mean_gradients_.push_back(std::move(sum));
    }
  });
  return mean_gradients_;
}

Vector GridSpace::gradient_product(SampleRule rule, const Vector& u, const Vector& v) const {
  if (rule == SampleRule::vertices) {
    Vector result = Vector::Zero(unknowns());
    for (const SparseMatrix& mean : mean_gradients()) result += (mean * u).cwiseProduct(mean * v);
    return result;
  }
  const std::size_t n = points_per_cell();
  Vector result(static_cast<Eigen::Index>(quadrature_points()));
  for_each_cell([&](std::size_t e, const CellPoints& points) {
    for (std::size_t q = 0; q < n; ++q) {
      Eigen::Vector3d of_u = Eigen::Vector3d::Zero(), of_v = of_u;
      for (std::size_t c = 0; c < n; ++c) {
        of_u += u[cells().corner[e * n + c]] * points[q].gradient[c];
        of_v += v[cells().corner[e * n + c]] * points[q].gradient[c];
      }
      result[static_cast<Eigen::Index>(e * n + q)] = of_u.dot(of_v);
    }
  });
  return result;
}

/// Triangles are numbered, and cut, as mesh_of does it.
ElementPoint GridSpace::element_point(Index face, double v, double w) const {
  assert(grid_.dimension() == 2 && dimension_ == 2);
  const std::int32_t shown = shown_cells(grid_, 0), i = face / 2 % shown, j = face / 2 / shown;
  // The corners of triangles in the cell, both of the even cells and then of the odd ones.
  constexpr std::array<std::array<std::array<double, 2>, 3>, 4> triangles = {
      {{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}, {{{0, 0}, {1, 0}, {0, 1}}}, {{{1, 0}, {1, 1}, {0, 1}}}}};
  const auto& [a, b, c] = triangles[at((i + j) % 2 * 2 + face % 2)];
  const double x = a[0] + v * (b[0] - a[0]) + w * (c[0] - a[0]), y = a[1] + v * (b[1] - a[1]) + w * (c[1] - a[1]);
  const std::int32_t right = (i + 1) % grid_.count[0], top = (j + 1) % grid_.count[1];
  ElementPoint p{{grid_.node(i, j, 0), grid_.node(right, j, 0), grid_.node(i, top, 0), grid_.node(right, top, 0)},
                 RowMatrix(3, 4)};
  const Eigen::RowVector4d dx(y - 1, 1 - y, -y, y), dy(x - 1, -x, 1 - x, x);
  p.jet.row(0) << (1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y;
  p.jet.row(1) = (b[0] - a[0]) * dx + (b[1] - a[1]) * dy;
  p.jet.row(2) = (c[0] - a[0]) * dx + (c[1] - a[1]) * dy;
  return p;
}

const std::vector<Point>& GridSpace::control() const {
  if (!grid_.even()) return grid_.points;
  std::call_once(control_once_, [&] { control_ = positions(SampleRule::vertices); });
  return control_;
}

std::vector<Point> GridSpace::positions(SampleRule rule) const {
  if (rule == SampleRule::vertices && !grid_.even()) return grid_.points;
  std::vector<Point> result;
  if (rule == SampleRule::vertices) {
    result.resize(grid_.nodes());
    parallel_for(result.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) result[v] = grid_.point(static_cast<std::int32_t>(v));
    });
    return result;
  }
  const std::size_t n = points_per_cell();
  result.resize(quadrature_points());
  for_each_cell([&](std::size_t e, const CellPoints&) {
    const CellCorners corners = grid_.even() ? even_cell(grid_.spacing) : cell_corners(cells(), e, grid_.points);
    const Eigen::Vector3d first = vector(grid_.point(cells().corner[e * n]));
    for (std::size_t q = 0; q < n; ++q) {
      Eigen::Vector3d x = first;
      for (std::size_t c = 0; c < n; ++c) x += rule_.value[q][c] * corners[c];
      result[e * n + q] = point(x);
    }
  });
  return result;
}

double GridSpace::side(const Point& normal, const CellPoint& p) const {
  return cells().one_sided && vector(normal).dot(p.normal) < 0 ? -1 : 1;
}

/// Sums over the quadrature points around every node, weighted with volumes and the node's function; of what has the
/// sign of the cell's normal, seen from the side of the node's `normal`, if there are any.
template <class Value, class At>
std::vector<Value> GridSpace::around_nodes(const std::vector<Point>& normal, const At& at_point) const {
  const std::size_t n = points_per_cell();
  std::vector<Value> sum(grid_.nodes(), Value{});
  CellPoints scratch;
  for (std::size_t e = 0; e < cells().count(); ++e) {
    const CellPoints& points = points_of(e, scratch);
    for (std::size_t q = 0; q < n; ++q) {
      const Value value = at_point(e * n + q, points[q]);
      for (std::size_t c = 0; c < n; ++c) {
        const std::size_t node = at(cells().corner[e * n + c]);
        const double sign = normal.empty() ? 1 : side(normal[node], points[q]);
        for (std::size_t k = 0; k < value.size(); ++k)
          sum[node][k] += sign * points[q].weight * rule_.value[q][c] * value[k];
      }
    }
  }
  return sum;
}

/// Of one-sided surfaces a normal at every node, that of the last cell there, by which to tell its sides.
std::vector<Point> GridSpace::sides() const {
  std::vector<Point> normal;
  if (!cells().one_sided) return normal;
  normal.resize(grid_.nodes());
  CellPoints scratch;
  for (std::size_t e = 0; e < cells().count(); ++e)
    for (std::size_t c = 0; c < points_per_cell(); ++c)
      normal[at(cells().corner[e * points_per_cell() + c])] = point(points_of(e, scratch)[0].normal);
  return normal;
}

std::vector<Point> GridSpace::normals(SampleRule rule) const {
  const bool vertices = rule == SampleRule::vertices;
  if (dimension_ != 2 || grid_.even())
    return std::vector<Point>(vertices ? grid_.nodes() : quadrature_points(), Point{0, 0, 1});
  if (vertices) {
    auto normal = around_nodes<Point>(sides(), [](std::size_t, const CellPoint& p) { return point(p.normal); });
    for (Point& n : normal) n = unit(n);
    return normal;
  }
  std::vector<Point> normal(quadrature_points());
  for_each_cell([&](std::size_t e, const CellPoints& points) {
    for (std::size_t q = 0; q < points_per_cell(); ++q) normal[e * points_per_cell() + q] = point(points[q].normal);
  });
  return normal;
}

/// The shape operator from the differences between the normals at the nodes.
std::vector<Tensor> GridSpace::curvature(SampleRule rule) const {
  const std::size_t n = points_per_cell();
  const std::vector<Point> normal = normals(SampleRule::vertices);
  const auto shape_operator = [&](std::size_t k, const CellPoint& p) {
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
    for (std::size_t c = 0; c < n; ++c) {
      const Point& own = normal[at(cells().corner[k / n * n + c])];
      s += side(own, p) * vector(own) * p.gradient[c].transpose();
    }
    return tensor((s + s.transpose()) / 2);
  };
  if (rule == SampleRule::quadrature) {
    std::vector<Tensor> result(quadrature_points());
    for_each_cell([&](std::size_t e, const CellPoints& points) {
      for (std::size_t q = 0; q < n; ++q) result[e * n + q] = shape_operator(e * n + q, points[q]);
    });
    return result;
  }
  std::vector<Tensor> result = around_nodes<Tensor>(normal, shape_operator);
  const Vector weight = *matrices().mass * Vector::Ones(unknowns());
  for (std::size_t v = 0; v < result.size(); ++v)
    for (double& x : result[v])
      x = weight[static_cast<Eigen::Index>(v)] > 0 ? x / weight[static_cast<Eigen::Index>(v)] : 0;
  return result;
}

PlaceGeometry GridSpace::geometry(SampleRule rule, bool with_curvature) const {
  PlaceGeometry places{positions(rule), normals(rule), {}};
  if (!with_curvature) return places;
  if (dimension_ == 2 && !grid_.even())
    places.curvature = principal_curvatures(curvature(rule), places.normal);
  else
    places.curvature.k1 = places.curvature.k2 = std::vector<double>(places.position.size(), 0.0);
  return places;
}

std::vector<double> GridSpace::at_quadrature_points(const std::vector<double>& at_nodes) const {
  const std::size_t n = points_per_cell();
  std::vector<double> values(quadrature_points());
  for_each_cell([&](std::size_t e, const CellPoints&) {
    for (std::size_t q = 0; q < n; ++q)
      for (std::size_t c = 0; c < n; ++c)
        values[e * n + q] += rule_.value[q][c] * at_nodes[at(cells().corner[e * n + c])];
  });
  return values;
}

Tensor lattice_tensor(const Lattice& lattice, const Tensor& line, const Kinetics::TensorField& rates) {
  const double theta = rates.theta[0], a1 = rates.a1[0], a2 = rates.a2[0];
  if (lattice.count[2] > 1) {
    require_unturned(rates);
    return volume_tensor(line, a1, a2);
  }
  if (lattice.count[1] > 1) return surface_tensor(line, {0, 0, 1}, theta, a1, a2);
  return {a1 * a1, 0, 0, 0, 0, 0};
}

std::vector<Tensor> GridSpace::tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const {
  const int dimension = dimension_;
  if (dimension == 3) require_unturned(rates);
  const std::size_t n = points_per_cell();
  std::vector<Tensor> result(quadrature_points());
  for_each_cell([&](std::size_t e, const CellPoints& points) {
    for (std::size_t q = 0; q < n; ++q) {
      const std::size_t k = e * n + q;
      if (dimension == 1) {
        const Point d = unit(point(points[q].dual[0]));
        result[k] = tensor(rates.a1[k] * rates.a1[k] * matrix_of(line_tensor(d)));
        continue;
      }
      Tensor mean{};
      for (std::size_t c = 0; c < n; ++c)
        for (std::size_t i = 0; i < mean.size(); ++i)
          mean[i] += rule_.value[q][c] * lines[lines.size() == 1 ? 0 : at(cells().corner[e * n + c])][i];
      result[k] = dimension == 2
                      ? surface_tensor(mean, point(points[q].normal), rates.theta[k], rates.a1[k], rates.a2[k])
                      : volume_tensor(mean, rates.a1[k], rates.a2[k]);
    }
  });
  return result;
}

std::vector<char> GridSpace::interior(std::vector<char> nodes) const {
  const std::size_t n = points_per_cell();
  std::vector<char> inner = nodes;
  for (std::size_t e = 0; e < cells().count(); ++e) {
    const Index* corner = cells().corner.data() + e * n;
    if (std::all_of(corner, corner + n, [&](Index v) { return nodes[at(v)] != 0; })) continue;
    for (std::size_t c = 0; c < n; ++c) inner[at(corner[c])] = 0;
  }
  return inner;
}

/// The faces of the cells there, as cells of one dimension less, with the quadrature of the cells: then the loads of
/// inflows are what the stiffness makes of the same slopes.
SpaceBorder GridSpace::border(const std::string& name) const {
  const std::optional<AxisEnd> side = grid_.dimension() == dimension_ ? axis_end(grid_, name) : std::nullopt;
  if (!side) return {};
  const std::size_t n = points_per_cell(), bit = std::size_t{1} << side->axis;
  std::map<Index, std::map<Index, double>> mass;
  const CellRule rule(dimension_ - 1, rule_.xi2);
  CellPoints points;
  for (std::size_t e = 0; e < cells().count(); ++e) {
    std::vector<std::size_t> face;
    for (std::size_t c = 0; c < n; ++c)
      if (((c & bit) != 0) == side->upper) face.push_back(c);
    const Index first = cells().corner[e * n + face[0]];
    const std::array<Index, 3> place = {first % grid_.count[0], first / grid_.count[0] % grid_.count[1],
                                        first / grid_.count[0] / grid_.count[1]};
    if (place[side->axis] != (side->upper ? grid_.count[side->axis] - 1 : 0)) continue;
    const CellCorners all = grid_.even() ? even_cell(grid_.spacing) : cell_corners(cells(), e, grid_.points);
    CellCorners corners{};
    for (std::size_t c = 0; c < face.size(); ++c) corners[c] = all[face[c]] - all[face[0]];
    fill_cell_points(rule, corners, points);
    for (std::size_t q = 0; q < face.size(); ++q)
      for (std::size_t c = 0; c < face.size(); ++c)
        for (std::size_t d = 0; d < face.size(); ++d)
          mass[cells().corner[e * n + face[c]]][cells().corner[e * n + face[d]]] +=
              points[q].weight * rule.value[q][c] * rule.value[q][d];
  }
  return border_of(mass);
}

std::shared_ptr<const Space> GridSpace::moved(std::vector<Point> control) const {
  Grid grid = grid_;
  grid.period = cells().period;
  grid.points = std::move(control);
  return std::shared_ptr<const Space>(new GridSpace(std::move(grid), dimension_, connectivity_));
}

namespace {

std::shared_ptr<const Space> node_space(const NodeShape& nodes) {
  if (const Atlas* atlas = std::get_if<Atlas>(&nodes)) return std::make_shared<const GridSpace>(*atlas);
  return std::make_shared<const GridSpace>(std::get<Grid>(nodes));
}

bool is_of_sheets(const NodeShape& nodes) {
  return std::holds_alternative<Grid>(nodes) || std::holds_alternative<Atlas>(nodes);
}

}  // namespace

constexpr Method grid_method = {.name = "grid",
                                .summary = "on the nodes of a grid",
                                .make_node_space = node_space,
                                .fits = is_of_sheets,
                                .memory = {130, 55}};

}  // namespace pelage

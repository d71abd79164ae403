#include "run/cell_lines.h"

#include <cmath>
#include <complex>

#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/cell_shapes.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point tangential(const Point& v, const Point& normal) {
  const double along = dot(v, normal);
  return unit({v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]});
}

using Complex = std::complex<double>;

/// Lines as squares of complex numbers in the frames of the cells, and the quadratic form of their roughness,
/// sum |z_j - t_ij z_i|^2 over neighbours with t_ij^(1/2) the turn of the frames.
class LineField {
 public:
  explicit LineField(const Cells& cells) : cells_(cells) {
    for (const Point& n : cells.normals) frame_.emplace_back(n);
    find_neighbours();
    lay_out();
  }

  Complex number(std::size_t cell, const Point& line) const {
    const PlanePoint p = frame_[cell].in(line);
    const Complex z(p[0], p[1]);
    return std::abs(z) > 0 ? z * z / std::norm(z) : 0;
  }

  /// (A + W) z = W wish.
  std::vector<Point> between(const std::vector<Point>& given) const {
    constexpr double exactly = 1e3;  // times as strong as neighbours
    SparseMatrix a = roughness_;
    Vector b = Vector::Zero(a.rows());
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (!(length(given[i]) > 0)) continue;
      const Complex z = exactly * number(i, given[i]);
      for (std::int32_t part = 0; part < 2; ++part) add(a, i, i, part, part, exactly);
      b[2 * static_cast<Eigen::Index>(i)] = z.real();
      b[2 * static_cast<Eigen::Index>(i) + 1] = z.imag();
    }
    return lines(solve(a, b, 1e-10));
  }

  /// By inverse iteration, from a field that depends on the form of the surface alone.
  std::vector<Point> smoothest() const {
    constexpr int rounds = 12;
    SparseMatrix a = roughness_;
    for (std::size_t i = 0; i < frame_.size(); ++i)
      for (std::int32_t part = 0; part < 2; ++part) add(a, i, i, part, part, 1e-2 / static_cast<double>(frame_.size()));
    Vector z(a.rows());
    for (std::size_t i = 0; i < frame_.size(); ++i) {
      const Point& n = cells_.normals[i];
      const Complex c = number(i, tangential({std::sin(2.3 * n[1] + 1) + 0.4, std::sin(1.9 * n[2] + 2) - 0.3, 0.7}, n));
      z[2 * static_cast<Eigen::Index>(i)] = c.real();
      z[2 * static_cast<Eigen::Index>(i) + 1] = c.imag();
    }
    for (int round = 0; round < rounds; ++round) {
      z = solve(a, z, 1e-3);
      z /= norm(z);
    }
    return lines(z);
  }

 private:
  void find_neighbours() {
    const CellNeighbours all(cells_.points, cells_.normals, cells_.radius);
    near_.resize(frame_.size());
    for (std::size_t i = 0; i < frame_.size(); ++i) {
      std::vector<CellNeighbour> found;
      all.find(i, 0.8 * cells_.radius, found);  // those that have sides in common, and few others
      for (const CellNeighbour& n : found) near_[i].push_back(n.cell);
      near_[i].push_back(static_cast<std::int32_t>(i));
      std::ranges::sort(near_[i]);
    }
  }

  /// Of j seen from i.
  Complex turn(std::size_t i, std::size_t j) const {
    const PlanePoint p = frame_[i].in(turned_into(frame_[j].e, cells_.normals[j], cells_.normals[i]));
    const Complex z(p[0], p[1]);
    return z * z / std::norm(z);
  }

  static void add(SparseMatrix& a, std::size_t i, std::size_t j, std::int32_t row, std::int32_t column, double value) {
    const auto number = [](std::size_t cell, std::int32_t part) { return 2 * static_cast<std::int32_t>(cell) + part; };
    a.value[at(a.pattern->find(number(i, row), number(j, column)))] += value;
  }

  void lay_out() {
    auto pattern = std::make_shared<SparsePattern>();
    pattern->rows = pattern->columns = 2 * static_cast<std::int32_t>(frame_.size());
    for (const auto& row : near_)
      for (int part = 0; part < 2; ++part) {
        for (const std::int32_t j : row) pattern->column.insert(pattern->column.end(), {2 * j, 2 * j + 1});
        pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
      }
    roughness_ = zeros(std::move(pattern));
    for (std::size_t i = 0; i < frame_.size(); ++i)
      for (const std::int32_t neighbour : near_[i]) {
        const auto j = at(neighbour);
        if (j == i) continue;
        const Complex t = -turn(i, j);
        for (std::int32_t part = 0; part < 2; ++part) {
          add(roughness_, i, i, part, part, 1);
          add(roughness_, i, j, part, part, t.real());
        }
        add(roughness_, i, j, 0, 1, -t.imag());
        add(roughness_, i, j, 1, 0, t.imag());
      }
  }

  static Vector solve(const SparseMatrix& a, const Vector& b, double tolerance) {
    Vector z = Vector::Zero(b.size());
    ConjugateGradientWork<Vector> work;
    const SolveReport report = conjugate_gradient(a, Jacobi(diagonal(a)), b, z, nullptr,
                                                  {.tolerance = tolerance, .max_iterations = 20000}, work);
    if (!report.converged)
      throw Error(Fault::numerics, "the direction field was not found: the solve did not converge");
    return z;
  }

  std::vector<Point> lines(const Vector& z) const {
    std::vector<Point> result;
    for (std::size_t i = 0; i < frame_.size(); ++i) {
      const auto k = 2 * static_cast<Eigen::Index>(i);
      const double angle = std::atan2(z[k + 1], z[k]) / 2;
      result.push_back(frame_[i].out({std::cos(angle), std::sin(angle)}));
    }
    return result;
  }

  const Cells& cells_;
  std::vector<TangentFrame> frame_;
  std::vector<std::vector<std::int32_t>> near_;  ///< itself among them
  SparseMatrix roughness_;
};

}  // namespace

std::vector<Point> wished_on_cells(const Cells& cells, const FieldWish& wish) {
  std::vector<Point> lines;
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    const Point& n = cells.normals[i];
    const Point wanted = unit(wish.axis ? *wish.axis : difference(cells.points[i], *wish.centre));
    constexpr double least = 0.02;  // what is tangential of less says nothing
    const Point line = length(cross(n, wanted)) > least ? tangential(wanted, n) : Point{};
    lines.push_back(wish.across ? cross(n, line) : line);
  }
  return lines;
}

std::vector<Point> cell_lines(const Cells& cells, const std::vector<Point>& given) {
  std::vector<Point> lines;
  bool some = false, all = !given.empty();
  for (std::size_t i = 0; i < given.size(); ++i) {
    lines.push_back(tangential(given[i], cells.normals[i]));
    const bool known = length(lines.back()) > 0;
    some |= known;
    all &= known;
  }
  if (all) return lines;
  const LineField field(cells);
  if (!some) return field.smoothest();
  const std::vector<Point> found = field.between(lines);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!(length(lines[i]) > 0)) lines[i] = found[i];
  return lines;
}

}  // namespace pelage

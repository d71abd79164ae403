#include "linear_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shape/vectors.h"

namespace plain {

namespace {

using pelage::Point;
using pelage::Triangle;
using pelage::TriangleMesh;

/// The rows with their columns; values 0.
Elements pattern(const TriangleMesh& mesh) {
  const std::size_t n = mesh.points.size();
  std::vector<std::vector<int>> rows(n);
  for (std::size_t i = 0; i < n; ++i) rows[i].push_back(static_cast<int>(i));
  for (const Triangle& t : mesh.triangles)
    for (const int i : t) rows[i].insert(rows[i].end(), t.begin(), t.end());
  Elements e;
  e.begin.push_back(0);
  for (std::vector<int>& row : rows) {
    std::sort(row.begin(), row.end());
    e.column.insert(e.column.end(), row.begin(), std::unique(row.begin(), row.end()));
    e.begin.push_back(static_cast<int>(e.column.size()));
  }
  e.stiffness.assign(e.column.size(), 0);
  e.mass.assign(n, 0);
  return e;
}

double& entry(Elements& e, int i, int j) {
  const auto row = e.column.begin() + e.begin[i];
  const auto end = e.column.begin() + e.begin[i + 1];
  return e.stiffness[std::lower_bound(row, end, j) - e.column.begin()];
}

}  // namespace

Elements assemble(const TriangleMesh& mesh) {
  Elements e = pattern(mesh);
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](int k) { return mesh.points[t[k % 3]]; };
    for (int k = 0; k < 3; ++k) {
      const Point a = pelage::difference(corner(k + 1), corner(k)), b = pelage::difference(corner(k + 2), corner(k));
      const double twice_area = pelage::length(pelage::cross(a, b)),
                   half_cotangent = pelage::dot(a, b) / (2 * twice_area);
      const int apex = t[k], i = t[(k + 1) % 3], j = t[(k + 2) % 3];
      entry(e, i, i) += half_cotangent;
      entry(e, j, j) += half_cotangent;
      entry(e, i, j) -= half_cotangent;
      entry(e, j, i) -= half_cotangent;
      e.mass[apex] += twice_area / 6;
    }
  }
  return e;
}

double spectral_radius(const Elements& e) {
  constexpr int rounds = 60;
  const int n = e.size();
  const int *begin = e.begin.data(), *column = e.column.data();
  std::vector<double> x(n), y(x.size());
  for (int i = 0; i < n; ++i) x[i] = std::sin(1.0 + i) * (i % 2 == 0 ? 1 : -1);
  double radius = 0;
  for (int round = 0; round < rounds; ++round) {
    double before = 0, after = 0;
    const double *from = x.data(), *k = e.stiffness.data(), *m = e.mass.data();
    double* to = y.data();
#pragma omp parallel for reduction(+ : before, after)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int s = begin[i]; s < begin[i + 1]; ++s) sum += k[s] * from[column[s]];
      to[i] = sum / m[i];
      before += m[i] * from[i] * from[i];
      after += m[i] * to[i] * to[i];
    }
    radius = std::sqrt(after / before);
    for (double& value : y) value /= radius;
    std::swap(x, y);
  }
  return radius;
}

std::vector<int> breadth_first(const TriangleMesh& mesh) {
  const Elements e = pattern(mesh);
  std::vector<int> order;
  std::vector<char> met(mesh.points.size(), 0);
  const auto meet = [&](int v) {
    if (met[v]) return;
    met[v] = 1;
    order.push_back(v);
  };
  for (int first = 0; first < e.size(); ++first) {
    std::size_t next = order.size();
    for (meet(first); next < order.size(); ++next) {
      const auto v = order[next];
      for (int s = e.begin[v]; s < e.begin[v + 1]; ++s) meet(e.column[s]);
    }
  }
  return order;
}

TriangleMesh renumbered(const TriangleMesh& mesh, const std::vector<int>& order) {
  TriangleMesh result;
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<int>(i);
    result.points.push_back(mesh.points[order[i]]);
  }
  for (Triangle t : mesh.triangles) {
    for (std::int32_t& v : t) v = place[v];
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace plain

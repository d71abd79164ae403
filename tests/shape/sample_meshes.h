#pragma once
// Small meshes for the tests, and an independent check that a mesh is a clean surface.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "pelage/triangle_mesh.h"

namespace pelage::test {

/// Regular tetrahedron around the origin, outward, volume 8/3.
inline TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}};
  return mesh;
}

/// Cube [0,1]^3 moved by `at`, outward, 12 triangles.
inline TriangleMesh cube(Point at = {0, 0, 0}) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back({at[0] + (i & 1), at[1] + (i >> 1 & 1), at[2] + (i >> 2)});
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

/// Torus of n x n quads cut in two, radii 3 and 1, outward.
inline TriangleMesh torus(int n = 12) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2 * M_PI * i / n, v = 2 * M_PI * j / n, r = 3 + std::cos(v);
      mesh.points.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
      const int a = n * i + j, b = n * ((i + 1) % n) + j, c = n * ((i + 1) % n) + (j + 1) % n, d = n * i + (j + 1) % n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

/// Flat n x n quads cut in two in the plane z = 0, with normal +z.
inline TriangleMesh sheet(int n = 4) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.points.push_back({1.0 * i, 1.0 * j, 0});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = (n + 1) * i + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// Both meshes as one.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto n = static_cast<std::int32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

/// Every corner its own vertex, as in an STL file.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto n = static_cast<std::int32_t>(result.points.size());
    for (std::int32_t v : t) result.points.push_back(mesh.points[v]);
    result.triangles.push_back({n, n + 1, n + 2});
  }
  return result;
}

/// What is wrong with a mesh that should be finite, manifold, consistently oriented and fully used; "" if nothing.
/// Written with sets and maps, unlike what it checks.
inline std::string first_violation(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> directed;
  std::map<int, std::map<int, int>> fan;  // around a vertex: next[v][a] = b for a triangle (v, a, b)
  for (const Point& p : mesh.points)
    for (double x : p)
      if (!std::isfinite(x)) return "coordinate not finite";
  for (const Attribute& a : mesh.attributes) {
    const std::size_t n =
        a.domain == Domain::vertex ? mesh.points.size() : (a.domain == Domain::corner ? 3 : 1) * mesh.triangles.size();
    if (a.values.size() != n * a.components) return "attribute " + a.name + " has a wrong length";
    for (double x : a.values)
      if (!std::isfinite(x)) return "attribute " + a.name + " not finite";
  }
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (a < 0 || a >= static_cast<int>(mesh.points.size())) return "vertex number out of range";
      if (a == b) return "triangle names a vertex twice";
      if (directed[{a, b}]++ > 0) return "edge " + std::to_string(a) + "-" + std::to_string(b) + " twice the same way";
      fan[a][b] = c;
    }
  if (fan.size() != mesh.points.size()) return "unused vertex";
  for (const auto& [v, next] : fan) {
    std::set<int> targets;
    for (const auto& [a, b] : next) targets.insert(b);
    int start = next.begin()->first, starts = 0;
    for (const auto& [a, b] : next)
      if (!targets.contains(a)) start = a, ++starts;
    if (starts > 1) return "vertex " + std::to_string(v) + " has several fans";
    std::size_t steps = 0;
    for (int a = start; next.contains(a) && steps <= next.size(); ++steps) {
      a = next.at(a);
      if (a == start) {
        ++steps;
        break;
      }
    }
    if (steps != next.size()) return "vertex " + std::to_string(v) + " has several fans";
  }
  return "";
}

inline double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Point &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

}  // namespace pelage::test

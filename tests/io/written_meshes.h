#pragma once
// Meshes with everything that the writers can hold, and the way through a file and back.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/random.h"
#include "pelage/triangle_mesh.h"
#include "shape/generators.h"
#include "shape/sample_meshes.h"

namespace pelage::test {

/// Normals, colours and two scalars on any mesh; all values are exactly floats, for comparison after a round trip.
inline void decorate(TriangleMesh& mesh) {
  Attribute normal{"normal", 3, Domain::vertex, {}}, color{"color", 3, Domain::vertex, {}};
  Attribute a{"a", 1, Domain::vertex, {}}, level{"level 2", 1, Domain::vertex, {}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point& p = mesh.points[v];
    const double length = std::hypot(p[0], p[1], p[2]);
    for (double x : p) normal.values.push_back(length > 0 ? static_cast<float>(x / length) : 0);
    for (std::uint64_t k = 0; k < 3; ++k) color.values.push_back(static_cast<float>(uniform(k, v)));
    a.values.push_back(static_cast<float>(8 * uniform(7, v) - 4));
    level.values.push_back(static_cast<double>(v % 5));
  }
  mesh.attributes.insert(mesh.attributes.end(), {normal, color, a, level});
}

/// A closed surface without uv, coordinates exactly floats.
inline TriangleMesh closed_mesh() {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=300");
  for (Point& p : mesh.points)
    for (double& x : p) x = static_cast<float>(x);
  decorate(mesh);
  return mesh;
}

/// A sheet with a boundary, whose uv jump along the middle line.
inline TriangleMesh seamed_mesh() {
  TriangleMesh mesh = sheet(4);
  for (Point& p : mesh.points) p[2] = p[0] * p[1] / 8;
  decorate(mesh);
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (const Triangle& t : mesh.triangles) {
    const double middle = (mesh.points[t[0]][0] + mesh.points[t[1]][0] + mesh.points[t[2]][0]) / 3;
    for (std::int32_t v : t) {
      uv.values.push_back(mesh.points[v][0] / 8 + (middle > 2 ? 0.5 : 0));
      uv.values.push_back(mesh.points[v][1] / 4);
    }
  }
  mesh.attributes.push_back(uv);
  return mesh;
}

/// A new empty folder for one test.
inline std::filesystem::path fresh_folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(PELAGE_BINARY_DIR) / "test-files" /
                                       (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// Largest difference between the values of an attribute at the corners of two meshes with the same triangles in
/// the same order, whatever the numbers of their vertices; infinite if one lacks it.
inline double corner_difference(const TriangleMesh& a, const Attribute* x, const TriangleMesh& b, const Attribute* y) {
  if (!x || !y || x->components != y->components || a.triangles.size() != b.triangles.size()) return INFINITY;
  const auto value = [](const TriangleMesh& mesh, const Attribute& attribute, std::size_t corner, int k) {
    const std::size_t tuple =
        attribute.domain == Domain::corner ? corner : static_cast<std::size_t>(mesh.triangles[corner / 3][corner % 3]);
    return attribute.values[attribute.components * tuple + k];
  };
  double worst = 0;
  for (std::size_t c = 0; c < 3 * a.triangles.size(); ++c)
    for (int k = 0; k < x->components; ++k) worst = std::max(worst, std::abs(value(a, *x, c, k) - value(b, *y, c, k)));
  return worst;
}

/// Are all corners at the same places, to the last bit?
inline bool same_places(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return false;
  for (std::size_t c = 0; c < 3 * a.triangles.size(); ++c)
    if (a.points[a.triangles[c / 3][c % 3]] != b.points[b.triangles[c / 3][c % 3]]) return false;
  return true;
}

/// What a reader's raw shape holds, as a triangle mesh, untouched by any repair.
template <class Raw>
TriangleMesh raw_mesh(const Raw& raw) {
  TriangleMesh mesh;
  mesh.points = raw.mesh.points;
  mesh.attributes = raw.mesh.attributes;
  for (std::size_t c = 0; c + 2 < raw.mesh.corners.size(); c += 3)
    mesh.triangles.push_back({raw.mesh.corners[c], raw.mesh.corners[c + 1], raw.mesh.corners[c + 2]});
  return mesh;
}

}  // namespace pelage::test

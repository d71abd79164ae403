#pragma once
// Triangle meshes as plain arrays: what is read, what the control mesh is, and what is written.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pelage/point.h"

namespace pelage {

using Triangle = std::array<std::int32_t, 3>;  ///< three vertex numbers, counter-clockwise from outside

/// Where the values of an attribute sit.
enum class Domain {
  vertex,  ///< one tuple per vertex
  corner   ///< one tuple per corner: tuple 3*f+k belongs to corner k of triangle f (uv with seams)
};

/// Named values over a mesh, tuple after tuple. Conventional names:
/// "normal" (3 components, unit length), "color" (3 or 4, linear light, 0..1), "uv" (2, v upwards).
struct Attribute {
  std::string name;
  int components = 1;
  Domain domain = Domain::vertex;
  std::vector<double> values;  ///< components * (number of vertices or corners)
};

/// Vertices, triangles and named attributes; says nothing about unknowns.
/// World units are those of the file; axes as in the file (right-handed).
struct TriangleMesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<Attribute> attributes;

  /// The attribute of that name, or nullptr.
  const Attribute* find(std::string_view name) const;
  Attribute* find(std::string_view name);
  /// Replaces an attribute of the same name.
  void set(Attribute attribute);
};

}  // namespace pelage

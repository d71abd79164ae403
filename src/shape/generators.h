#pragma once
// The built-in shapes.

#include <string>
#include <string_view>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Names of the built-in shapes: "animal", "cube", "knot", "plane", "sphere", "torus".
std::vector<std::string> builtin_shape_names();

/// Does the text name a built-in shape rather than a file, that is, begin with "builtin:"?
bool is_builtin_shape(std::string_view spec);

/// The shape of "builtin:NAME" or "builtin:NAME?n=COUNT" with about COUNT vertices (10000 if not given; the nearest
/// count that the shape's regular pattern allows). All but the plane are closed; all are oriented outward.
///   sphere  radius 1; an icosahedron cut into frequency^2 triangles per face: 12 vertices of valence 5
///   torus   circles of radius 1 and 0.4 around z; all valences 6, nearly equilateral
///   knot    a tube of radius 0.5 around the (2,3) torus knot on the torus of radii 2 and 1; all valences 6
///   cube    edge 1, sharp, centred at 0
///   plane   the square [0, 1]^2 in z = 0, normal +z
///   animal  a cub, see shape/animal.h
/// Throws Error(Fault::usage) for an unknown name or parameter, or a count outside 100 .. 4 million.
TriangleMesh builtin_shape(const std::string& spec);
/// Throws as builtin_shape() does, and makes nothing.
void check_builtin_shape(const std::string& spec);

}  // namespace pelage

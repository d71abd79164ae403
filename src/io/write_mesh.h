#pragma once
// What can be known before a mesh is written (pelage/io.h).

#include <string>

#include "pelage/polygon_mesh.h"

namespace pelage {

/// Refuses what save would refuse about the name (Fault::usage) or the folder (Fault::output): to be
/// asked before the long work whose result goes there.
void check_mesh_path(const std::string& path);

/// The extension of a file's name, with its dot.
std::string extension_of(const std::string& path);

/// Error(Fault::numerics) that names the first value of a point or attribute which is not a finite number
/// within the range of 32-bit floats; attributes that are doubles need only be finite.
void require_finite(const std::vector<Point>& points, const std::vector<Attribute>& attributes);
inline void require_finite(const PolygonMesh& mesh) { require_finite(mesh.points, mesh.attributes); }

}  // namespace pelage

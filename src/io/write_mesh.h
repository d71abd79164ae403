#pragma once
// Writing a mesh: the extension of the file name picks the format.

#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Writes the mesh with all its attributes that the format can hold (see the header of each format's
/// writer). Coordinates are never turned, scaled or moved. The file appears whole or not at all.
///
/// Errors: Fault::usage for an unknown extension; Fault::numerics for a value that is not finite or does not
/// fit a 32-bit float, naming attribute and vertex; Fault::output when the file cannot be written.
void write_mesh(const TriangleMesh& mesh, const std::string& path);

/// Refuses what write_mesh would refuse about the name (Fault::usage) or the folder (Fault::output): to be
/// asked before the long work whose result goes there.
void check_mesh_path(const std::string& path);

/// The extensions that write_mesh knows, with the dot.
std::vector<std::string> mesh_extensions();

/// Error(Fault::numerics) that names the first value of a point or attribute which is not a finite number
/// within the range of 32-bit floats.
void require_finite(const TriangleMesh& mesh);

}  // namespace pelage

#pragma once
// Files of volumes: VTK's unstructured grids (.vtu) and Gmsh's meshes (.msh).

#include <string>
#include <string_view>
#include <vector>

#include "pelage/tet_mesh.h"
#include "shape/finding.h"

namespace pelage {

struct TetFile {
  TetMesh volume;                 ///< positive tetrahedra, nodes that are used, finite values
  std::vector<Finding> findings;  ///< what was found in the file and what was done about it
};

/// Whether the name ends as those of files that read_tets takes.
bool is_tet_file(const std::string& path);

/// Error(Fault::input), with the line or the byte, for a file that cannot be read, is damaged, has no volume, or does
/// not hold what it declares: memory is taken only for what is there.
TetFile read_tets(const std::string& path);

/// The same from the bytes of a file of that name.
TetFile read_tet_bytes(std::string_view bytes, const std::string& name);

/// Writes a volume as .vtu; the file appears whole or not at all. Errors: Fault::usage for another extension;
/// Fault::numerics for a value that is not finite; Fault::output when the file cannot be written.
void write_tets(const TetMesh& volume, const std::string& path);

/// The extensions of files that read_tets takes, with the dot.
std::vector<std::string> readable_tet_extensions();
/// The extensions that write_tets takes, with the dot.
std::vector<std::string> tet_extensions();

}  // namespace pelage

#pragma once
// What can be said of a shape before it is read, and files that read_shape() refuses.

#include <string>

#include "pelage/io.h"

namespace pelage {

/// Error as read_shape() gives it for a name of an unknown kind, an unknown built-in shape and a file that cannot be
/// opened: to be asked before anything is done.
void check_shape_path(const std::string& path);

/// Whether read_shape() would give a grid.
bool is_grid_shape(const std::string& path);

/// The shape with an attribute at the corners of its file's polygons, or of its triangles where it has no file.
ShapeFile with_attribute(ShapeFile file, Attribute at_corners);

/// Polygons as they are, cut into triangles but not repaired: edges may have any number of faces, in any order. For
/// cells alone (shape/cells.h). Error(Fault::input) where there are none, or numbers or coordinates that are none.
ShapeFile read_polygons(const std::string& path);

}  // namespace pelage

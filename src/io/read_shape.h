#pragma once
// What can be said of a shape before it is read.

#include <string>

namespace pelage {

/// Error as read_shape() gives it for a name of an unknown kind, an unknown built-in shape and a file that cannot be
/// opened: to be asked before anything is done.
void check_shape_path(const std::string& path);

/// Whether read_shape() would give a grid.
bool is_grid_shape(const std::string& path);

}  // namespace pelage

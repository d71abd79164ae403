#pragma once
// Paths of SVG (Scalable Vector Graphics 1.1, section 8.3) as curves.

#include "gridgen/curve.h"

namespace pelage {

struct SvgPath {
  Curve curve;
  bool closed = false;  ///< by Z, or because it ends where it begins
};

/// The path of path data: M L H V C S Q T A Z, absolute and relative. As SVG's y axis points down, y is negated, so
/// that the region stands as it was drawn. Error(usage), located, for what is no path data, a path without extent, and
/// several subpaths.
SvgPath parse_svg_path(const Formula& data);

/// The path data in an SVG file: of the path with that id, or, without one, of the only path. Error(input) where the
/// file cannot be read or has no such path, or where the path has a transform.
Formula svg_file_path(const std::string& file, const std::string& id);

}  // namespace pelage

#pragma once
// What is painted on a shape becomes attributes of its vertices.

#include "catalog/size.h"
#include "pelage/recipe.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// The shape with an attribute for each brush; none is called like another or like one that the shape has.
/// `normals`: whether its triangles tell which side a place is on, so that paint does not come through.
/// Error(Fault::usage), located, for names and lengths.
void paint_brushes(const std::vector<Brush>& brushes, const ShapeScale& scale, bool normals, TriangleMesh& shape);

/// A line for each brush with a stroke too narrow for the triangles of the shape to show its edge.
std::vector<std::string> coarse_brushes(const std::vector<Brush>& brushes, const ShapeScale& scale,
                                        const TriangleMesh& shape);

/// Error(Fault::usage), located, for names that no formula can read, that are given twice or that a species has.
void require_brush_names(const std::vector<Brush>& brushes, const std::vector<std::string>& species);

}  // namespace pelage

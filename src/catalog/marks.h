#pragma once
// Formulas of the place at the vertices of a mesh, before there is a surface.

#include "react/place_formula.h"
#include "shape/texture.h"
#include "shape/topology.h"

namespace pelage {

/// A shape with its images, and the length unit and seed of a stage.
struct MeshPlaces {
  const TriangleMesh& shape;
  const std::vector<Texture>& textures;
  double length_unit = 1;
  std::uint64_t seed = 1;
};

/// One value per vertex of a formula that a mesh alone tells.
std::vector<double> vertex_values(const PlaceFormula& formula, const MeshPlaces& places);

/// The vertices where a formula is not 0. Error(Fault::usage) at `where` if there is none.
std::vector<Index> marked_vertices(const PlaceFormula& formula, const MeshPlaces& places, const Location& where);

/// The smallest value over the vertices; for the details that a texture has between them, the shape is split until its
/// edges are as short as the values ask, `edge` being short enough for 1. Error(Fault::usage) at `where` when one is
/// not greater than 0.
double smallest_factor(const PlaceFormula& formula, const MeshPlaces& places, double edge, const Location& where);

}  // namespace pelage

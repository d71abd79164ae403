#pragma once
// What formulas may read from the places of a surface: positions, normals, curvatures, attributes of the mesh.

#include <map>
#include <string>
#include <vector>

#include "discretise/curvature.h"
#include "pelage/triangle_mesh.h"
#include "react/kinetics.h"
#include "shape/scalar_attributes.h"
#include "shape/texture.h"

namespace pelage {

/// Those that the model reads and the mesh has.
VertexAttributes attributes_read(const Model& model, const TriangleMesh& mesh);

/// Those textures of which one of the symbols speaks.
std::vector<Texture> textures_read(const std::vector<Symbol>& symbols, const std::vector<Texture>& textures);

/// What textures say at the vertices of the mesh, which has "uv" if there are any.
VertexAttributes texture_values(const std::vector<Texture>& textures, const TriangleMesh& mesh);

/// What those that the model reads say at the vertices after `levels` refinements of the mesh, uv being linear over its
/// triangles.
VertexAttributes refined_textures(const Model& model, const std::vector<Texture>& textures, const TriangleMesh& mesh,
                                  int levels);

/// The attributes after `levels` refinements of the mesh, linear over its triangles.
VertexAttributes refined(const TriangleMesh& mesh, VertexAttributes attributes, int levels);

/// Fields at samples. Curvatures and attributes that the model does not read stay empty.
struct PlaceFields {
  std::vector<Point> position, normal;
  PrincipalCurvatures curvature;
  VertexAttributes attributes;

  /// Views on the fields for a Kinetics; valid as long as they are.
  Places places(double length_unit) const;
};

/// At the limit positions of the vertices. `attributes` are values at the vertices of the discretisation.
PlaceFields vertex_fields(const Model& model, const Discretisation& discretisation, const std::vector<Point>& control,
                          VertexAttributes attributes);

/// At the quadrature points; attributes are linear in the parameters of each triangle.
PlaceFields quadrature_fields(const Model& model, const Discretisation& discretisation,
                              const std::vector<Point>& control, const VertexAttributes& attributes);

}  // namespace pelage

#pragma once
// What rides with the material points of a stage wherever the surface goes: attributes, textures, fields of earlier
// stages, directions, masks, random fields.

#include "discretise/space.h"
#include "run/program.h"
#include "run/world.h"
#include "shape/scalar_attributes.h"

namespace pelage {

struct Material {
  VertexAttributes attributes;  ///< that the formulas of the stage read, at the nodes
  std::vector<Tensor> lines;    ///< of the direction field at the nodes, or one for all; empty when nothing is
                                ///< anisotropic

  /// At samples that move.
  struct AtSamples {
    std::vector<DrawnField> drawn;  ///< the random fields, drawn at the initial place; none where it stays there
    std::vector<double> mask;       ///< not 0 inside; empty without a mask
  };
  AtSamples at_nodes, at_quadrature_points;

  std::vector<char> inside;          ///< nodes in the mask; empty without one
  std::shared_ptr<const Held> held;  ///< coefficients that stay as they are; null without a mask

  const AtSamples& at(SampleRule rule) const { return rule == SampleRule::vertices ? at_nodes : at_quadrature_points; }
};

/// Of a stage that begins on the surface as it is now. `fields`: of earlier stages at the nodes, by name. Errors of
/// directions.
Material make_material(const Program& program, const StageProgram& stage, const World& world,
                       const VertexAttributes& fields);

/// What the formulas of a stage read from its samples.
struct PlaceFields {
  PlaceGeometry geometry;
  VertexAttributes attributes;

  /// Views on all of it for a Kinetics; valid as long as it and the material are.
  Places places(const Material::AtSamples& material, const StageProgram& stage) const;
};
PlaceFields place_fields(const Model& model, const Space& space, SampleRule rule, const VertexAttributes& at_nodes);

/// Whether the diffusion of species i needs a stiffness matrix of its own.
bool has_own_stiffness(const Model& model, std::size_t i);
bool has_own_stiffness(const Model& model);
/// Whether any formula is evaluated at the quadrature points whatever the stepper: of a diffusion or a flux.
bool acts_at_quadrature_points(const Model& model);

/// Those textures of which one of the symbols speaks.
std::vector<Texture> textures_read(const std::vector<Symbol>& symbols, const std::vector<Texture>& textures);

/// What textures say at the vertices of the mesh, which has "uv" if there are any.
VertexAttributes texture_values(const std::vector<Texture>& textures, const TriangleMesh& mesh);

}  // namespace pelage

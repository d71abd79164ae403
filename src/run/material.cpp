#include "run/material.h"

#include <algorithm>

#include "base/suggest.h"
#include "react/place_values.h"
#include "run/directions.h"
#include "run/random_points.h"

namespace pelage {

namespace {

bool reads(const std::vector<Symbol>& symbols, Symbol::Kind kind) {
  return std::ranges::any_of(symbols, [&](const Symbol& s) { return s.kind == kind; });
}

VertexAttributes attributes_of_mesh(const Program& program, const std::vector<Symbol>& symbols, const World& world) {
  const VertexAttributes all = scalar_attributes(*program.shape);
  VertexAttributes read;
  std::vector<std::string> names;
  for (const auto& [name, values] : all) names.push_back(name);
  for (const Symbol& s : symbols)
    if (const std::string* name = matching_name(s.name, names); s.kind == Symbol::Kind::attribute && name)
      read[s.name] = world.at_nodes(all.at(*name));
  for (const Texture& texture : textures_read(symbols, program.textures)) read.merge(world.at_nodes(texture));
  return read;
}

std::vector<double> distance_to_points(const StageProgram& stage, const Space& space) {
  const std::vector<Point> nodes = space.geometry(SampleRule::vertices, false).position;
  const Lattice* lattice = space.lattice();
  if (stage.jitter && lattice && lattice->count[1] > 1 && lattice->count[2] == 1)
    return distance_to_jittered_diamonds(nodes, *stage.points, *stage.jitter, stage.seed, stage.period);
  return distance_to_random_points(nodes, *stage.points, stage.seed, stage.period);
}

VertexAttributes attributes_at_nodes(const Program& program, const StageProgram& stage, const World& world,
                                     const VertexAttributes& fields) {
  const std::vector<Symbol> symbols = place_symbols(stage.model);
  VertexAttributes attributes;
  if (program.shape) attributes = attributes_of_mesh(program, symbols, world);
  for (const Symbol& s : symbols) {
    if (s.kind != Symbol::Kind::attribute) continue;
    if (const auto field = fields.find(s.name); field != fields.end()) attributes.insert(*field);
    if (stage.points && s.name == points_attribute) attributes[s.name] = distance_to_points(stage, world.space());
  }
  return attributes;
}

/// The mask at the samples of a rule, as they are when the stage begins.
std::vector<double> mask_at(const StageProgram& stage, const Space& space, SampleRule rule, const Material& material) {
  const PlaceFields fields = place_fields(stage.model, space, rule, material.attributes);
  return mask_values(stage.model, fields.places(material.at(rule), stage), stage.seed);
}

/// Samples of the steppers that hold any are at the nodes: there coefficients are held instead, so that the field is
/// exactly what it was wherever all that make it up are.
void add_mask(const StageProgram& stage, const Space& space, Material& material) {
  material.at_nodes.mask = mask_at(stage, space, SampleRule::vertices, material);
  if (acts_at_quadrature_points(stage.model))
    material.at_quadrature_points.mask = mask_at(stage, space, SampleRule::quadrature, material);
  for (const double m : material.at_nodes.mask) material.inside.push_back(m != 0);
  material.held = std::make_shared<const Held>(stage.excluded ? space.interior(material.inside) : material.inside);
}

/// At the initial places of the samples; nothing where they stay there.
std::vector<DrawnField> drawn_once(const World& world, const StageProgram& stage, SampleRule rule) {
  if (!world.surface()) return {};
  const std::vector<Point> positions = world.initial_positions(rule);
  return draw_random_fields(place_symbols(stage.model),
                            {.positions = positions, .length_unit = stage.length_unit, .origin = stage.origin},
                            stage.seed);
}

/// The shape as it is now.
TriangleMesh shape_now(const Program& program, const World& world) {
  TriangleMesh shape = *program.shape;
  shape.points = world.points();
  return shape;
}

std::vector<Tensor> lines_at_nodes(const Program& program, const StageProgram& stage, const World& world) {
  if (program.nodes) return node_lines(*program.nodes, world.space(), *program.shape, stage.directions);
  if (!world.hierarchy()) return {};  // a space that was given
  return world.at_nodes(vertex_lines(shape_now(program, world), stage.directions, world.hierarchy()->topology(0)));
}

}  // namespace

std::vector<Texture> textures_read(const std::vector<Symbol>& symbols, const std::vector<Texture>& textures) {
  std::vector<Texture> read;
  for (const Texture& texture : textures) {
    const auto all = color_names(texture.name);
    const std::vector<std::string> names(all.begin(), all.end());
    if (std::ranges::any_of(symbols, [&](const Symbol& s) {
          return s.kind == Symbol::Kind::attribute && matching_name(s.name, names);
        }))
      read.push_back(texture);
  }
  return read;
}

VertexAttributes texture_values(const std::vector<Texture>& textures, const TriangleMesh& mesh) {
  VertexAttributes values;
  for (const Texture& texture : textures)
    values.merge(texture_attributes(texture, mesh.triangles, mesh.points.size(), *mesh.find("uv")));
  return values;
}

bool has_own_stiffness(const Model& model, std::size_t i) {
  return model.anisotropic(i) || !model.diffusion_constant(i);
}

bool has_own_stiffness(const Model& model) {
  for (std::size_t i = 0; i < model.species_count(); ++i)
    if (has_own_stiffness(model, i)) return true;
  return false;
}

bool acts_at_quadrature_points(const Model& model) {
  return has_own_stiffness(model) || !model.equations().fluxes.empty();
}

Places PlaceFields::places(const Material::AtSamples& material, const StageProgram& stage) const {
  Places places{.positions = geometry.position,
                .normals = geometry.normal,
                .k1 = geometry.curvature.k1,
                .k2 = geometry.curvature.k2};
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  places.length_unit = stage.length_unit;
  places.origin = stage.origin;
  places.period = stage.period;
  places.drawn = material.drawn;
  places.mask = material.mask;
  return places;
}

PlaceFields place_fields(const Model& model, const Space& space, SampleRule rule, const VertexAttributes& at_nodes) {
  PlaceFields fields{space.geometry(rule, reads(place_symbols(model), Symbol::Kind::curvature)), at_nodes};
  if (rule == SampleRule::quadrature)
    for (auto& [name, values] : fields.attributes) values = space.at_quadrature_points(values);
  return fields;
}

Material make_material(const Program& program, const StageProgram& stage, const World& world,
                       const VertexAttributes& fields) {
  const Space& space = world.space();
  Material material;
  material.attributes = attributes_at_nodes(program, stage, world, fields);
  material.at_nodes.drawn = drawn_once(world, stage, SampleRule::vertices);
  if (acts_at_quadrature_points(stage.model) || stage.stepper->samples == SampleRule::quadrature)
    material.at_quadrature_points.drawn = drawn_once(world, stage, SampleRule::quadrature);
  if (stage.model.anisotropic()) material.lines = lines_at_nodes(program, stage, world);
  if (stage.model.held()) add_mask(stage, space, material);
  return material;
}

}  // namespace pelage

#include "look/dress.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/quantile.h"
#include "base/suggest.h"
#include "look/layers.h"
#include "look/ramp.h"
#include "shape/normals.h"
#include "shape/refine.h"
#include "shape/scalar_attributes.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Colours are linear along the edges of the output: so many edges per wavelength keep spots round.
constexpr double edges_per_wavelength = 16;
/// Splitting for the sake of smooth colours stops here: about 100 MB of output.
constexpr std::size_t most_triangles = 1'500'000;
/// The ends of the ramp are quantiles, so that a few extreme samples do not bleach the rest.
constexpr double ramp_quantile = 0.005;
/// What the colours of the shape are called in the coat.
constexpr const char* input_color = "input_color";

/// A mesh on its way through refinement: flat positions and attributes at midpoints, fields by the method's rule.
struct Tessellation {
  Topology topology;
  std::vector<Point> flat;     ///< on the shape's own triangles
  std::vector<Point> control;  ///< of the surface; empty before the level of the run
  std::vector<std::vector<double>> fields;
  std::vector<Attribute> attributes;
};

void refine(Tessellation& t, bool loop) {
  const Refinement middle = midpoint_refine(t.topology);
  t.flat = combine(middle.stencils, t.flat);
  for (Attribute& a : t.attributes) refine_attribute(a, middle);
  if (!t.control.empty()) {
    const Stencils stencils = loop ? loop_refine(t.topology).stencils : middle.stencils;
    t.control = combine(stencils, t.control);
    for (auto& f : t.fields) f = combine(stencils, f);
  }
  t.topology = make_topology(middle.stencils.rows(), middle.triangles);
}

std::vector<Attribute> kept_attributes(std::vector<Attribute> attributes, const std::vector<std::string>& species) {
  std::vector<Attribute> kept;
  for (Attribute& a : attributes) {
    if (a.name == "normal") continue;             // made anew
    if (a.name == "color") a.name = input_color;  // makes room for the coat
    if (std::find(species.begin(), species.end(), a.name) == species.end()) kept.push_back(std::move(a));
  }
  return kept;
}

/// The shape's triangles at the level of the run, with the run's control points and fields.
Tessellation at_run_level(CoatFields& fields) {
  Tessellation t;
  t.topology = make_topology(fields.shape.points.size(), std::move(fields.shape.triangles));
  t.flat = std::move(fields.shape.points);
  t.attributes = kept_attributes(std::move(fields.shape.attributes), fields.species);
  for (int level = 0; level < fields.levels; ++level) refine(t, false);
  t.control = std::move(fields.control);
  t.fields = std::move(fields.coefficients);
  return t;
}

int levels_for_colour(const Tessellation& t, double wavelength) {
  double edge = prevailing_edge(t.topology.triangles, t.control);
  std::size_t triangles = t.topology.triangles.size();
  int levels = 0;
  while (edge > wavelength / edges_per_wavelength && 4 * triangles <= most_triangles) {
    edge /= 2;
    triangles *= 4;
    ++levels;
  }
  return levels;
}

int checked_detail(const Tessellation& t, int detail) {
  double triangles = static_cast<double>(t.topology.triangles.size());
  for (int i = 0; i < detail && triangles <= 3e7; ++i) triangles *= 4;
  if (triangles > 3e7)
    throw Error(Fault::usage,
                "detail " + std::to_string(detail) + " makes more than 30 million triangles; ask for less");
  return detail;
}

std::vector<double> flattened(const std::vector<Point>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Point& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

std::vector<Point> limit_normals(const LimitMasks& masks, const std::vector<Point>& control) {
  std::vector<Point> normals = combine(masks.tangent1, control);
  const std::vector<Point> other = combine(masks.tangent2, control);
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit(cross(normals[i], other[i]));
  return normals;
}

/// Colours of a field, its lowest and highest half percent at the ends of the ramp.
std::vector<double> colours(const std::vector<double>& field, const Look& look) {
  std::vector<double> sorted = field;
  const double low = quantile(sorted, ramp_quantile), high = quantile(sorted, 1 - ramp_quantile);
  const Ramp ramp = named_ramp(look.ramp.value);
  std::vector<double> values(3 * field.size());
  parallel_for(field.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double place = high > low ? std::clamp((field[i] - low) / (high - low), 0.0, 1.0) : 0.5;
      const Color color = ramp(look.invert ? 1 - place : place);
      std::copy(color.begin(), color.end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  });
  return values;
}

std::size_t shown_species(const std::vector<std::string>& species, const Look& look) {
  if (!look.species) return species.size() - 1;
  const auto found = std::find(species.begin(), species.end(), look.species->value);
  if (found == species.end())
    throw Error(Fault::usage, unknown_name("species", look.species->value, species), look.species->where);
  return static_cast<std::size_t>(found - species.begin());
}

/// "STAGE.SPECIES" as file formats like it.
std::string attribute_name(std::string field) {
  std::ranges::replace(field, '.', '_');
  return field;
}

/// What the layers may read from the shape and its textures.
VertexAttributes layer_attributes(const std::vector<Texture>& textures, const Tessellation& t,
                                  const TriangleMesh& mesh) {
  std::vector<Attribute> given = t.attributes;
  for (Attribute& a : given)
    if (a.name == input_color) a.name = "color";  // as formulas of stages know it
  VertexAttributes attributes = scalar_attributes(given);
  for (const Attribute& uv : given)
    for (const Texture& texture : textures)
      if (uv.name == "uv") attributes.merge(texture_attributes(texture, mesh.triangles, mesh.points.size(), uv));
  return attributes;
}

void paint_layers(const Look& look, const CoatFields& fields, const Tessellation& t, const TriangleMesh& mesh,
                  const std::vector<Point>& normals, std::vector<double>& color) {
  if (look.layers.empty()) return;
  Places places{.positions = mesh.points, .normals = normals};
  const VertexAttributes attributes = layer_attributes(fields.textures, t, mesh);
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  for (std::size_t i = 0; i < fields.species.size(); ++i) places.attributes[fields.species[i]] = t.fields[i];
  paint(look.layers, fields.species, places, color);
}

}  // namespace

TriangleMesh dress(CoatFields fields, const Look& look) {
  const bool loop = fields.loop;
  const std::size_t shown = shown_species(fields.species, look);
  Tessellation t = at_run_level(fields);
  const int levels = look.detail ? checked_detail(t, *look.detail) : levels_for_colour(t, fields.wavelength);
  for (int level = 0; level < levels; ++level) refine(t, loop);

  TriangleMesh mesh;
  std::vector<Point> normals;
  if (loop) {
    const LimitMasks masks = loop_limit_masks(t.topology);
    for (auto& f : t.fields) f = combine(masks.position, f);
    if (!look.keep_shape) {
      mesh.points = combine(masks.position, t.control);
      normals = limit_normals(masks, t.control);
    }
  }
  if (mesh.points.empty()) {
    mesh.points = std::move(t.flat);
    normals = vertex_normals(t.topology.triangles, mesh.points);
  }
  mesh.triangles = std::move(t.topology.triangles);
  mesh.set({"normal", 3, Domain::vertex, flattened(normals)});
  std::vector<double> color = colours(t.fields[shown], look);
  paint_layers(look, fields, t, mesh, normals, color);
  mesh.set({"color", 3, Domain::vertex, std::move(color)});
  for (std::size_t i = 0; i < t.fields.size(); ++i)
    mesh.set({attribute_name(fields.species[i]), 1, Domain::vertex, std::move(t.fields[i])});
  for (Attribute& a : t.attributes) mesh.set(std::move(a));
  return mesh;
}

}  // namespace pelage

#include "look/tessellation.h"

#include <algorithm>
#include <cmath>

#include "pelage/error.h"
#include "shape/locate.h"
#include "shape/loop_subdivision.h"
#include "shape/normals.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Colours are linear along the edges of the output: with so many per wavelength borders of black and white are smooth.
constexpr double edges_per_wavelength = 12;
/// Splitting for the sake of smooth colours stops here: about 100 MB of output.
constexpr std::size_t most_triangles = 1'500'000;
/// More than this no memory holds.
constexpr double most_triangles_asked = 3e7;

std::vector<Attribute> kept_attributes(std::vector<Attribute> attributes) {
  std::vector<Attribute> kept;
  for (Attribute& a : attributes) {
    if (a.name == "normal") continue;                  // made anew
    if (a.name == "uv") a.type = NumberType::float32;  // between corners they are computed
    kept.push_back(std::move(a));
  }
  return kept;
}

int levels_for_colour(const CoatFields& fields) {
  const Topology& finest = fields.hierarchy->topology(fields.hierarchy->finest());
  double edge = prevailing_edge(finest.triangles, fields.control);
  std::size_t triangles = finest.triangles.size();
  int levels = 0;
  while (edge > fields.wavelength / edges_per_wavelength && 4 * triangles <= most_triangles) {
    edge /= 2;
    triangles *= 4;
    ++levels;
  }
  return levels;
}

int checked_detail(const CoatFields& fields, int detail) {
  auto triangles = static_cast<double>(fields.hierarchy->topology(fields.hierarchy->finest()).triangles.size());
  for (int i = 0; i < detail && triangles <= most_triangles_asked; ++i) triangles *= 4;
  if (triangles > most_triangles_asked)
    throw Error(Fault::usage,
                "detail " + std::to_string(detail) + " makes more than 30 million triangles; ask for less");
  return detail;
}

/// The levels of the run and those that the colours need beyond.
Hierarchy levels_of(const CoatFields& fields, const TessellationRequest& request) {
  Hierarchy h = *fields.hierarchy;
  const int more = request.detail ? checked_detail(fields, *request.detail) : levels_for_colour(fields);
  for (int level = 0; level < more; ++level) h.refine();
  return h;
}

/// What the layers may read from the shape and its textures.
VertexAttributes layer_attributes(const std::vector<Texture>& textures, const Tessellation& t) {
  VertexAttributes attributes = scalar_attributes(t.attributes, t.triangles, t.samples.size());
  for (const Attribute& uv : t.attributes)
    for (const Texture& texture : textures)
      if (uv.name == "uv") attributes.merge(texture_attributes(texture, t.triangles, t.samples.size(), uv));
  return attributes;
}

/// One making of a tessellation.
class Tessellator {
 public:
  Tessellator(const CoatFields& fields, const TessellationRequest& request)
      : fields_(fields), request_(request), levels_(levels_of(fields, request)) {}

  Tessellation make() {
    Tessellation t;
    t.triangles = finest().triangles;
    add_geometry(t);
    find_places(t.samples);
    add_fields(t.samples);
    if (request_.curvature) add_curvature(t.samples);
    t.attributes = kept_attributes(fields_.shape->attributes);
    t.links = fields_.shape->links;
    for (Attribute& a : t.attributes) levels_.interpolate(a, 0, levels_.finest());
    if (request_.attributes) t.samples.attributes = layer_attributes(fields_.textures, t);
    t.metres_per_unit = fields_.shape->metres_per_unit;
    t.samples.length_unit = fields_.length_unit;
    t.samples.origin = fields_.origin;
    t.samples.seed = fields_.seed;
    return t;
  }

 private:
  const Topology& finest() const { return levels_.topology(levels_.finest()); }
  int run_level() const { return fields_.hierarchy->finest(); }
  std::vector<Point> flat(const std::vector<Point>& points) const {
    return levels_.interpolated(points, 0, levels_.finest());
  }
  std::vector<Point> refined(const std::vector<Point>& control) const {
    return levels_.refined(control, run_level(), levels_.finest());
  }

  /// Where the vertices lie on the mesh of the fields, if they have one of their own.
  void find_places(const CoatSamples& samples) {
    if (!fields_.mesh) return;
    const SurfaceWalk mesh(*fields_.mesh->shared_topology(), fields_.space->control());
    places_ =
        locate(finest(), request_.flat ? loop_limits(finest(), refined(fields_.control)) : samples.position, mesh);
  }
  std::vector<std::vector<double>> on_mesh(const std::vector<std::vector<double>>& at_nodes) const {
    return fields_at(places_, *fields_.mesh->shared_topology(), fields_.space->control(), at_nodes);
  }

  void add_fields(CoatSamples& samples) const {
    if (fields_.mesh) {
      samples.fields = on_mesh(fields_.coefficients);
      return;
    }
    for (const std::vector<double>& coefficients : fields_.coefficients) {
      std::vector<double> field = levels_.refined(coefficients, run_level(), levels_.finest());
      samples.fields.push_back(fields_.method->smooth ? loop_limits(finest(), field) : std::move(field));
    }
  }

  void add_geometry(Tessellation& t) const {
    CoatSamples& s = t.samples;
    const bool moved = !fields_.initial_control.empty();
    if (fields_.method->smooth && !request_.flat) {
      const std::vector<Point> control = refined(fields_.control);
      s.position = loop_limits(finest(), control);
      s.normal = loop_limit_normals(finest(), control);
      if (moved) s.drawn_at = loop_limits(finest(), refined(fields_.initial_control));
    } else {
      s.position = flat(fields_.points);
      s.normal = vertex_normals(t.triangles, s.position);
      if (moved) s.drawn_at = flat(fields_.shape->points);
    }
  }

  /// Those of the surface at the nodes of the run, linear between them.
  void add_curvature(CoatSamples& samples) const {
    PrincipalCurvatures k = fields_.space->geometry(SampleRule::vertices, true).curvature;
    if (fields_.mesh) {
      auto at_places = on_mesh({k.k1, k.k2});
      samples.curvature = {std::move(at_places[0]), std::move(at_places[1])};
      return;
    }
    samples.curvature = {levels_.interpolated(std::move(k.k1), 1, run_level(), levels_.finest()),
                         levels_.interpolated(std::move(k.k2), 1, run_level(), levels_.finest())};
  }

  const CoatFields& fields_;
  const TessellationRequest& request_;
  const Hierarchy levels_;
  std::vector<MeshPlace> places_;  ///< of the vertices on the mesh of the fields
};

}  // namespace

TessellationRequest tessellation_request(const Look& look) {
  if (look.keep_shape && look.detail.value_or(0) > 0)
    throw Error(Fault::usage, "a shape that is kept is not split: leave the detail out, or take flat instead");
  return {look.keep_shape || look.flat, look.keep_shape ? 0 : look.detail};
}

TessellationRequest tessellation_request(const Look& look, const Paint& paint) {
  const bool curvature =
      std::ranges::any_of(paint.symbols(), [](const Symbol& s) { return s.kind == Symbol::Kind::curvature; });
  TessellationRequest request = tessellation_request(look);
  request.curvature = curvature;
  request.attributes = !paint.layers.empty();
  return request;
}

namespace {

/// The nodes of a grid or an atlas, whose cells are as fine as its colours can be.
Tessellation nodes_of_shape(const CoatFields& fields, const TessellationRequest& request) {
  if (request.flat || request.detail.value_or(0) > 0)
    throw Error(Fault::usage, "a grid is coloured at its own nodes: leave flat, keep_shape and detail out");
  Tessellation t;
  t.triangles = fields.shape->triangles;
  PlaceGeometry places = fields.space->geometry(SampleRule::vertices, request.curvature);
  t.samples.position = std::move(places.position);
  t.samples.normal = std::move(places.normal);
  t.samples.curvature = std::move(places.curvature);
  t.samples.fields = fields.coefficients;
  t.attributes = kept_attributes(fields.shape->attributes);
  t.metres_per_unit = fields.shape->metres_per_unit;
  if (request.attributes) t.samples.attributes = layer_attributes(fields.textures, t);
  t.samples.length_unit = fields.length_unit;
  t.samples.origin = fields.origin;
  t.samples.period = fields.period;
  t.samples.seed = fields.seed;
  return t;
}

}  // namespace

Tessellation tessellate(const CoatFields& fields, const TessellationRequest& request) {
  if (fields.nodes) return nodes_of_shape(fields, request);
  return Tessellator(fields, request).make();
}

}  // namespace pelage

#include "look/tessellation.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "look/cell_tessellation.h"
#include "look/solid_tessellation.h"
#include "pelage/error.h"
#include "shape/locate.h"
#include "shape/loop_subdivision.h"
#include "shape/normals.h"
#include "shape/one_sided.h"
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

}  // namespace

std::vector<Attribute> kept_attributes(std::vector<Attribute> attributes) {
  std::vector<Attribute> kept;
  for (Attribute& a : attributes) {
    if (a.name == "normal") continue;                  // made anew
    if (a.name == "uv") a.type = NumberType::float32;  // between corners they are computed
    kept.push_back(std::move(a));
  }
  return kept;
}

namespace {

int checked_detail(std::size_t count, int detail) {
  auto triangles = static_cast<double>(count);
  for (int i = 0; i < detail && triangles <= most_triangles_asked; ++i) triangles *= 4;
  if (triangles > most_triangles_asked)
    throw Error(Fault::usage,
                "detail " + std::to_string(detail) + " makes more than 30 million triangles; ask for less");
  return detail;
}

}  // namespace

int levels_to_split(double edge, std::size_t triangles, double wavelength, const std::optional<int>& detail) {
  if (detail) return checked_detail(triangles, *detail);
  int levels = 0;
  while (edge > wavelength / edges_per_wavelength && 4 * triangles <= most_triangles) {
    edge /= 2;
    triangles *= 4;
    ++levels;
  }
  return levels;
}

double most_tessellated(const TessellationRequest& request, double finest, double shape) {
  const double begun = request.flat ? shape : finest;
  if (request.detail) return begun * std::pow(4.0, *request.detail);
  return std::max(begun, static_cast<double>(most_triangles));
}

namespace {

/// The levels of the run and those that the colours need beyond.
Hierarchy levels_of(const CoatFields& fields, const TessellationRequest& request) {
  Hierarchy h = *fields.hierarchy;
  const std::vector<Triangle>& finest = h.topology(h.finest()).triangles;
  const double edge = prevailing_edge(finest, fields.control);
  const int more = levels_to_split(edge, finest.size(), fields.wavelength, request.detail);
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

}  // namespace

void take_rest(const CoatFields& fields, const TriangleMesh& shape, const TessellationRequest& request,
               Tessellation& t) {
  t.metres_per_unit = shape.metres_per_unit;
  if (request.attributes) t.samples.attributes = layer_attributes(fields.textures, t);
  t.samples.length_unit = fields.length_unit;
  t.samples.wavelength = fields.wavelength;
  t.samples.origin = fields.origin;
  t.samples.period = fields.period;
  t.samples.seed = fields.seed;
}

namespace {

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
    t.on_mesh = std::move(places_);
    t.attributes = kept_attributes(fields_.shape->attributes);
    t.links = fields_.shape->links;
    for (Attribute& a : t.attributes) levels_.interpolate(a, 0, levels_.finest());
    take_rest(fields_, *fields_.shape, request_, t);
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
      if (finest().creases.any()) add_creases(t, control);
      if (moved) s.drawn_at = loop_limits(finest(), refined(fields_.initial_control));
    } else {
      s.position = flat(fields_.points);
      s.normal = vertex_normals(t.triangles, s.position);
      if (moved) s.drawn_at = flat(fields_.shape->points);
    }
  }

  void add_creases(Tessellation& t, const std::vector<Point>& control) const {
    const CornerNormals normals(finest(), control);
    for (std::size_t f = 0; f < t.triangles.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) t.corner_normal.push_back(normals.at(f, k));
    t.creased = levels_.shared_topology(levels_.finest());
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
  request.attributes = !paint.layers.empty() || !paint.channels.empty() || paint.holes;
  return request;
}

void require_own_nodes(const TessellationRequest& request) {
  if (request.flat || request.detail.value_or(0) > 0)
    throw Error(Fault::usage, "the shape is coloured at its own nodes: leave flat, keep_shape and detail out");
}

namespace {

template <class T>
void take(std::vector<T>& values, const std::vector<std::int32_t>& from, std::size_t components = 1) {
  std::vector<T> taken;
  taken.reserve(components * from.size());
  for (const std::int32_t v : from)
    for (std::size_t k = 0; k < components; ++k) taken.push_back(values[components * static_cast<std::size_t>(v) + k]);
  values = std::move(taken);
}

/// A vertex has one normal: where a surface with one side turns over it gets two, which look to either side.
void give_sides(Tessellation& t) {
  const std::vector<std::int32_t> node = cut_between_sides(t.triangles, t.samples.size());
  CoatSamples& s = t.samples;
  for (auto* vectors : {&s.position, &s.normal}) take(*vectors, node);
  for (std::vector<double>& field : s.fields) take(field, node);
  for (auto& [name, values] : s.attributes) take(values, node);
  for (Attribute& a : t.attributes)
    if (a.domain == Domain::vertex) take(a.values, node, static_cast<std::size_t>(a.components));
  const bool curved = !s.curvature.k1.empty();
  for (auto* k : {&s.curvature.k1, &s.curvature.k2})
    if (curved) take(*k, node);
  const std::vector<Point> seen = vertex_normals(t.triangles, s.position);
  for (std::size_t v = 0; v < s.size(); ++v) {
    if (dot(seen[v], s.normal[v]) >= 0) continue;
    for (double& x : s.normal[v]) x = -x;
    if (curved) std::tie(s.curvature.k1[v], s.curvature.k2[v]) = std::pair{-s.curvature.k2[v], -s.curvature.k1[v]};
  }
}

}  // namespace

Tessellation tessellate_nodes(const CoatFields& fields, const TessellationRequest& request) {
  if (!shows_surface(fields.nodes)) require_own_nodes(request);
  Tessellation t;
  t.triangles = fields.shape->triangles;
  PlaceGeometry places = fields.space->geometry(SampleRule::vertices, request.curvature);
  t.samples.position = std::move(places.position);
  t.samples.normal = std::move(places.normal);
  t.samples.curvature = std::move(places.curvature);
  if (!fields.initial_control.empty()) t.samples.drawn_at = fields.initial_control;
  t.samples.fields = fields.coefficients;
  t.attributes = kept_attributes(fields.shape->attributes);
  take_rest(fields, *fields.shape, request, t);
  return t;
}

Tessellation tessellate(const CoatFields& fields, const TessellationRequest& request) {
  if (as<Cells>(fields.nodes)) return tessellate_cells(fields, request);
  if (shows_surface(fields.nodes)) return tessellate_solid(fields, request);
  if (!fields.nodes) return Tessellator(fields, request).make();
  Tessellation t = tessellate_nodes(fields, request);
  if (const Atlas* atlas = as<Atlas>(fields.nodes); atlas && atlas->one_sided) give_sides(t);
  return t;
}

CoatSamples samples_at_nodes(const CoatFields& fields, const TessellationRequest& request) {
  return tessellate_nodes(fields, request).samples;
}

}  // namespace pelage

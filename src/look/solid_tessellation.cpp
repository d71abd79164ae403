#include "look/solid_tessellation.h"

#include "base/parallel.h"
#include "shape/normals.h"
#include "shape/split_edges.h"
#include "shape/tet_places.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Colours are linear along edges; with so many per wavelength the borders of a flat surface are smooth.
constexpr double edges_per_wavelength = 24;
constexpr std::size_t most_triangles = 1'500'000;

TriangleMesh split_surface(const CoatFields& fields, const TessellationRequest& request) {
  const TriangleMesh& surface = *as<TetMesh>(fields.nodes)->surface;
  TriangleMesh mesh{surface.points, surface.triangles, kept_attributes(surface.attributes), surface.links,
                    surface.metres_per_unit};
  if (!request.detail) split_long_edges(mesh, fields.wavelength / edges_per_wavelength, most_triangles);
  const int levels = levels_to_split(0, mesh.triangles.size(), fields.wavelength, request.detail);
  for (int level = 0; level < levels; ++level) split_edges(mesh, 0);
  return mesh;
}

std::vector<double> values_at(const std::vector<TetPlace>& places, const std::vector<double>& at_nodes) {
  std::vector<double> values(places.size(), 0.0);
  parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      for (std::size_t k = 0; k < 4; ++k)
        values[v] += places[v].share[k] * at_nodes[static_cast<std::size_t>(places[v].node[k])];
  });
  return values;
}

/// What lies at these places of the volume goes where its nodes have gone.
void move_along(const std::vector<TetPlace>& places, const std::vector<Point>& from, const std::vector<Point>& to,
                std::vector<Point>& points) {
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto n = static_cast<std::size_t>(places[v].node[k]);
      const Point way = difference(to[n], from[n]);
      for (std::size_t d = 0; d < 3; ++d) points[v][d] += places[v].share[k] * way[d];
    }
}

}  // namespace

bool shows_surface(const std::shared_ptr<const NodeShape>& nodes) {
  const TetMesh* volume = as<TetMesh>(nodes);
  return volume && volume->surface;
}

Tessellation tessellate_solid(const CoatFields& fields, const TessellationRequest& request) {
  const TetMesh& volume = *as<TetMesh>(fields.nodes);
  TriangleMesh surface = split_surface(fields, request);
  const std::vector<TetPlace> places = places_in(volume, surface.points);
  Tessellation t;
  CoatSamples& s = t.samples;
  for (const std::vector<double>& field : fields.coefficients) s.fields.push_back(values_at(places, field));
  if (const std::vector<Point>& now = fields.space->control(); now != volume.points) {
    s.drawn_at = surface.points;
    move_along(places, volume.points, now, surface.points);
  }
  t.triangles = std::move(surface.triangles);
  s.position = std::move(surface.points);
  s.normal = vertex_normals(t.triangles, s.position);
  if (request.curvature) s.curvature.k1 = s.curvature.k2 = std::vector<double>(s.position.size(), 0.0);
  t.attributes = std::move(surface.attributes);
  t.links = std::move(surface.links);
  t.sharp = true;
  take_rest(fields, *volume.surface, request, t);
  return t;
}

}  // namespace pelage

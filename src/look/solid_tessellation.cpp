#include "look/solid_tessellation.h"

#include <algorithm>

#include "base/parallel.h"
#include "shape/normals.h"
#include "shape/split_edges.h"
#include "shape/tet_places.h"

namespace pelage {

namespace {

/// Colours are linear along edges; with so many per wavelength the borders of a flat surface are smooth.
constexpr double edges_per_wavelength = 24;
constexpr std::size_t most_triangles = 1'500'000;

/// Carried along while edges are split; no file has an attribute without a name.
constexpr const char* moved_points = "";

/// Where the volume was filled, with the points where they are now as an attribute if it has moved.
TriangleMesh split_surface(const CoatFields& fields, const TessellationRequest& request) {
  const TriangleMesh& surface = *as<TetMesh>(fields.nodes)->surface;
  TriangleMesh mesh{surface.points, surface.triangles, kept_attributes(surface.attributes), surface.links,
                    surface.metres_per_unit};
  if (!fields.surface.empty()) {
    Attribute now{moved_points, 3, Domain::vertex, {}};
    for (const Point& p : fields.surface) now.values.insert(now.values.end(), p.begin(), p.end());
    mesh.attributes.push_back(std::move(now));
  }
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
  if (const Attribute* now = surface.find(moved_points)) {
    s.drawn_at = surface.points;
    for (std::size_t v = 0; v < surface.points.size(); ++v)
      std::copy_n(&now->values[3 * v], 3, surface.points[v].begin());
    std::erase_if(surface.attributes, [](const Attribute& a) { return a.name == moved_points; });
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

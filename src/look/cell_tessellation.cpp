#include "look/cell_tessellation.h"

#include "base/parallel.h"
#include "shape/cell_values.h"
#include "shape/normals.h"
#include "shape/refine.h"
#include "shape/soup_edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Triangles with points and attributes at them.
struct SplitSurface {
  std::vector<Triangle> triangles;
  std::vector<Point> points;
  std::vector<Attribute> attributes;

  void split() {
    const Topology t = soup_topology(points.size(), std::move(triangles));
    points = split_points(t, points);
    for (Attribute& a : attributes) split_attribute(t, a);
    triangles = split_triangles(t);
  }
};

/// Of points of a cloud: their own, or that of the nearest cell.
std::vector<Point> cloud_normals(const Cells& cells, const CellValues& values) {
  std::vector<Point> normals = vertex_normals(*cells.on);
  parallel_for(normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (length(normals[v]) > 0) continue;
      normals[v] = cells.normals[static_cast<std::size_t>(values.nearest(cells.on->points[v]))];
    }
  });
  return normals;
}

/// Fields of the cells at places with these normals.
std::vector<std::vector<double>> values_at(const CellValues& cells, const std::vector<Point>& places,
                                           const std::vector<Point>& normals,
                                           const std::vector<std::vector<double>>& fields) {
  std::vector<std::vector<double>> result(fields.size(), std::vector<double>(places.size()));
  parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<CellValues::Weight> found;
    for (std::size_t v = begin; v < end; ++v) {
      cells.at(places[v], normals[v], found);
      for (std::size_t f = 0; f < fields.size(); ++f)
        for (const CellValues::Weight& w : found) result[f][v] += w.share * fields[f][static_cast<std::size_t>(w.cell)];
    }
  });
  return result;
}

}  // namespace

Tessellation tessellate_cells(const CoatFields& fields, const TessellationRequest& request) {
  const Cells& cells = *as<Cells>(fields.nodes);
  SplitSurface surface{cells.on->triangles, cells.on->points, kept_attributes(cells.on->attributes)};
  const bool cloud = surface.triangles.empty();
  const double edge = cloud ? 0 : prevailing_edge(surface.triangles, surface.points);
  const int levels = cloud ? 0 : levels_to_split(edge, surface.triangles.size(), fields.wavelength, request.detail);
  for (int level = 0; level < levels; ++level) surface.split();
  const CellValues values(cells);
  Tessellation t;
  t.triangles = std::move(surface.triangles);
  CoatSamples& s = t.samples;
  s.position = std::move(surface.points);
  s.normal = cloud ? cloud_normals(cells, values) : vertex_normals(t.triangles, s.position);
  s.fields = values_at(values, s.position, s.normal, fields.coefficients);
  if (request.curvature) {
    const PrincipalCurvatures k = fields.space->geometry(SampleRule::vertices, true).curvature;
    auto at_places = values_at(values, s.position, s.normal, {k.k1, k.k2});
    s.curvature = {std::move(at_places[0]), std::move(at_places[1])};
  }
  t.attributes = std::move(surface.attributes);
  t.links = cells.on->links;
  take_rest(fields, *cells.on, request, t);
  return t;
}

}  // namespace pelage

#include "shape/repair.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "shape/drop_faces.h"
#include "shape/near_copies.h"
#include "shape/numbered_mesh.h"
#include "shape/orient.h"
#include "shape/parts.h"
#include "shape/stitch.h"

namespace pelage {

namespace {

// Fourth powers of lengths (squared areas) must neither overflow nor vanish in double precision.
constexpr double largest_coordinate = 1e75;
constexpr double smallest_extent = 1e-75;

void check_coordinates(const NumberedMesh& work) {
  const std::vector<Point>& points = work.mesh.points;
  Point low = points[work.mesh.triangles[0][0]], high = low;
  for (const Triangle& t : work.mesh.triangles)
    for (std::int32_t v : t)
      for (int k = 0; k < 3; ++k) {
        const double x = points[v][k];
        if (!std::isfinite(x))
          throw ShapeFault(ShapeFault::Element::vertex, work.vertex_number[v],
                           "its coordinates are not finite; correct the file");
        if (std::abs(x) > largest_coordinate)
          throw ShapeFault(ShapeFault::Element::vertex, work.vertex_number[v],
                           "its coordinates are too large to compute with; scale the shape down");
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
  if (std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}) < smallest_extent)
    throw ShapeFault(ShapeFault::Element::none, 0, "the shape is (nearly) a single point; nothing can grow on it");
}

void check_range(const TriangleMesh& mesh, const std::vector<std::int32_t>& face_number) {
  if (mesh.triangles.empty())
    throw ShapeFault(ShapeFault::Element::none, 0, "the shape has no faces; nothing can grow on it");
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::int32_t v : mesh.triangles[f])
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
        throw ShapeFault(ShapeFault::Element::face, face_number[f],
                         "refers to vertex " + std::to_string(v) + ", but there are " +
                             std::to_string(mesh.points.size()) + " vertices; correct the file");
}

void drop_unused(NumberedMesh& work, std::vector<Finding>& findings) {
  const Dropped dropped = drop_unused_vertices(work);
  if (dropped.count == 0) return;
  findings.push_back(
      {"unused-vertices",
       counted(dropped.count, "vertex") + " in no face (first: vertex " + std::to_string(dropped.first) + "); removed",
       dropped.count, dropped.first, true});
}

/// Height over the longest side, relative to it; 0 for collinear corners.
double flatness(const Point& a, const Point& b, const Point& c) {
  double u[3], v[3], w2 = 0, u2 = 0, v2 = 0;
  for (int k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    u2 += u[k] * u[k];
    v2 += v[k] * v[k];
    w2 += (c[k] - b[k]) * (c[k] - b[k]);
  }
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return std::sqrt(x * x + y * y + z * z) / std::max({u2, v2, w2});
}

/// Collinear triangles hold the surface together, so they stay; the user should know.
void report_zero_area(const NumberedMesh& work, std::vector<Finding>& findings) {
  constexpr double flat = 1e-13;  // some hundred roundings of a coordinate, relative to the longest side
  Finding finding{"zero-area-faces", "", 0, 0, false};
  const std::vector<Point>& p = work.mesh.points;
  for (std::size_t f = 0; f < work.mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = work.mesh.triangles[f];
    if (flatness(p[a], p[b], p[c]) < flat && finding.count++ == 0) finding.element = work.face_number[f];
  }
  if (finding.count == 0) return;
  finding.text = counted(finding.count, "face") + " without area (first: face " + std::to_string(finding.element) +
                 "); kept, the pattern may be poor there";
  findings.push_back(finding);
}

NumberedMesh number(TriangleMesh mesh, const std::vector<std::int32_t>& source_face) {
  NumberedMesh work;
  work.face_number = source_face;
  if (source_face.empty()) {
    work.face_number.resize(mesh.triangles.size());
    std::iota(work.face_number.begin(), work.face_number.end(), 0);
  }
  work.vertex_number.resize(mesh.points.size());
  std::iota(work.vertex_number.begin(), work.vertex_number.end(), 0);
  work.mesh = std::move(mesh);
  return work;
}

}  // namespace

void clear_non_finite_attributes(std::vector<Attribute>& attributes, std::vector<Finding>& findings) {
  for (Attribute& a : attributes) {
    Finding finding{"non-finite-attribute", "", 0, 0, true};
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      if (std::isfinite(a.values[i])) continue;
      if (finding.count++ == 0) finding.element = i / a.components;
      a.values[i] = 0;
    }
    if (finding.count == 0) continue;
    finding.text = counted(finding.count, "value") + " of attribute \"" + a.name + "\" not finite; set to 0";
    findings.push_back(finding);
  }
}

TriangleMesh repair(TriangleMesh mesh, std::vector<Finding>& findings, const std::vector<std::int32_t>& source_face) {
  NumberedMesh work = number(std::move(mesh), source_face);
  check_range(work.mesh, work.face_number);
  check_coordinates(work);
  drop_unused(work, findings);
  clear_non_finite_attributes(work.mesh.attributes, findings);

  drop_collapsed_faces(work, findings);
  separate_closed_parts(work, findings);
  std::vector<std::int32_t> place(work.mesh.points.size());
  std::iota(place.begin(), place.end(), 0);
  drop_duplicate_faces(work, place, findings);
  EdgeTable edges(work.mesh.triangles, work.mesh.points.size());
  const std::vector<std::int32_t> part = parts_of(work.mesh);
  std::vector<std::int32_t> open =
      part.empty() ? open_places(work.mesh, edges) : open_places_in_parts(work.mesh, edges, part, findings);
  if (open != place) {
    place = std::move(open);
    drop_duplicate_faces(work, place, findings);
    edges = edges_of_places(work.mesh, place);
  }
  if (work.mesh.triangles.empty())
    throw ShapeFault(ShapeFault::Element::none, 0, "no face of the shape has an area; nothing can grow on it");

  const EdgePairs pairs = pair_half_edges(work, place, edges, findings);
  renumber_by_fans(work, pairs, findings);
  orient(work, pairs.opposite, findings);
  drop_unused_vertices(work);  // those of removed faces, which are reported already
  report_zero_area(work, findings);
  const bool closed = std::find(pairs.opposite.begin(), pairs.opposite.end(), -1) == pairs.opposite.end();
  if (!closed) report_near_copies(work, findings);
  return std::move(work.mesh);
}

}  // namespace pelage

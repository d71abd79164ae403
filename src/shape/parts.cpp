#include "shape/parts.h"

#include <algorithm>
#include <map>
#include <string>

#include "shape/places.h"
#include "shape/stitch.h"

namespace pelage {

namespace {

/// Vertices by part: triangles of different parts share none.
struct OwnVertices {
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> source;  ///< the vertex of the mesh
};

OwnVertices own_vertices(const TriangleMesh& mesh, const std::vector<std::int32_t>& part) {
  OwnVertices own;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> number;
  own.triangles.reserve(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto next = static_cast<std::int32_t>(own.source.size());
      const auto [found, is_new] = number.try_emplace({mesh.triangles[f][k], part[f]}, next);
      if (is_new) own.source.push_back(mesh.triangles[f][k]);
      t[k] = found->second;
    }
    own.triangles.push_back(t);
  }
  return own;
}

std::vector<char> closed_parts(const OwnVertices& own, const std::vector<std::int32_t>& part) {
  std::vector<char> closed(static_cast<std::size_t>(*std::ranges::max_element(part)) + 1, 1);
  const EdgeTable edges(own.triangles, own.source.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() != 2) closed[part[edges[e][0] / 3]] = 0;
  return closed;
}

std::vector<std::int32_t> vertex_parts(const TriangleMesh& mesh, const std::vector<std::int32_t>& part) {
  std::vector<std::int32_t> result(mesh.points.size(), -1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (const std::int32_t v : mesh.triangles[f])
      if (result[v] < 0) result[v] = part[f];
  return result;
}

/// Places of the compared vertices, those of different parts apart.
std::vector<std::int32_t> places_within(const TriangleMesh& mesh, const std::vector<char>& compared,
                                        const std::vector<std::int32_t>& part) {
  const std::vector<std::int32_t> all = same_places(mesh.points, compared);
  std::vector<std::int32_t> result(all.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> first;
  for (std::size_t v = 0; v < all.size(); ++v)
    result[v] = first.try_emplace({all[v], part[v]}, static_cast<std::int32_t>(v)).first->second;
  return result;
}

std::vector<char> open_vertices(const TriangleMesh& mesh, const EdgeTable& edges) {
  std::vector<char> open(mesh.points.size(), 0);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1) open[tail(mesh.triangles, edges[e][0])] = open[tip(mesh.triangles, edges[e][0])] = 1;
  return open;
}

/// Which parts have open edges that none of the other parts in question closes.
bool drop_misfits(const TriangleMesh& mesh, const EdgeTable& edges, const std::vector<std::int32_t>& merged,
                  const std::vector<std::int32_t>& part, std::vector<char>& fits) {
  const EdgeTable joined = edges_of_places(mesh, merged);
  std::vector<char> paired(3 * mesh.triangles.size(), 0);
  for (std::size_t e = 0; e < joined.size(); ++e)
    for (const HalfEdge h : joined[e]) paired[h] = joined[e].size() > 1;
  bool changed = false;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() != 1 || paired[edges[e][0]]) continue;
    char& fit = fits[part[edges[e][0] / 3]];
    changed = changed || fit;
    fit = 0;
  }
  return changed;
}

}  // namespace

std::vector<std::int32_t> parts_of(const TriangleMesh& mesh) {
  const Attribute* object = mesh.find("object");
  std::vector<std::int32_t> part;
  if (!object || object->domain != Domain::face || object->components != 1) return part;
  for (const double x : object->values)
    part.push_back(x >= 0 && x < static_cast<double>(object->labels.size()) ? static_cast<std::int32_t>(x) : 0);
  return part;
}

void separate_closed_parts(NumberedMesh& work, std::vector<Finding>& findings) {
  const std::vector<std::int32_t> part = parts_of(work.mesh);
  if (part.empty()) return;
  const OwnVertices own = own_vertices(work.mesh, part);
  if (own.source.size() == work.mesh.points.size()) return;  // none is shared, as every vertex is used
  const std::vector<char> closed = closed_parts(own, part);
  const std::vector<std::int32_t> owner = vertex_parts(work.mesh, part);
  std::vector<std::int32_t> source(work.mesh.points.size());
  for (std::size_t v = 0; v < source.size(); ++v) source[v] = static_cast<std::int32_t>(v);
  std::vector<std::int32_t> copy(own.source.size(), -1);
  Finding touching{"touching-parts", "", 0, 0, true};
  for (std::size_t f = 0; f < part.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& v = work.mesh.triangles[f][k];
      if (owner[v] == part[f] || (!closed[part[f]] && !closed[owner[v]])) continue;
      std::int32_t& mine = copy[own.triangles[f][k]];
      if (mine < 0) {
        if (touching.count++ == 0) touching.element = work.vertex_number[v];
        mine = static_cast<std::int32_t>(source.size());
        source.push_back(v);
      }
      v = mine;
    }
  if (touching.count == 0) return;
  gather_vertices(work, source);
  touching.text = "parts that share vertices (first: vertex " + std::to_string(touching.element) +
                  "); separated with the help of " + counted(touching.count, "vertex") + " more";
  findings.push_back(touching);
}

std::vector<std::int32_t> open_places_in_parts(const TriangleMesh& mesh, const EdgeTable& edges,
                                               const std::vector<std::int32_t>& part, std::vector<Finding>& findings) {
  const std::vector<std::int32_t> owner = vertex_parts(mesh, part);
  const std::vector<std::int32_t> within = places_within(mesh, open_vertices(mesh, edges), owner);
  const EdgeTable left = edges_of_places(mesh, within);
  const std::vector<char> open = open_vertices(mesh, left);
  std::vector<char> fits(static_cast<std::size_t>(*std::ranges::max_element(part)) + 1, 1);
  std::vector<std::int32_t> wished, merged;
  do {
    std::vector<char> compared(open.size(), 0);
    for (std::size_t v = 0; v < open.size(); ++v)
      if (open[v] && fits[owner[v]]) compared[within[v]] = 1;
    const std::vector<std::int32_t> across = same_places(mesh.points, compared);
    merged = within;
    for (std::int32_t& v : merged) v = across[v];
    if (wished.empty()) wished = merged;
  } while (drop_misfits(mesh, left, merged, part, fits));
  if (merged != wished)
    findings.push_back({"parts-apart", "parts that touch along open edges; kept apart", 1, 0, false});
  return merged;
}

}  // namespace pelage

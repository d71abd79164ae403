#include "shape/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "base/box.h"
#include "base/unions.h"
#include "pelage/error.h"
#include "shape/grid.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using Node = std::int32_t;

constexpr std::array<const char*, 4> side_names = {"south", "east", "north", "west"};

/// The nodes of a side in counter-clockwise order around the grid.
std::vector<Node> side_nodes(const Grid& grid, std::size_t side) {
  const Node nx = grid.count[0], ny = grid.count[1];
  const bool along_x = side % 2 == 0;
  std::vector<Node> nodes;
  for (Node k = 0; k < (along_x ? nx : ny); ++k)
    nodes.push_back(along_x ? grid.node(k, side == 0 ? 0 : ny - 1, 0) : grid.node(side == 3 ? 0 : nx - 1, k, 0));
  if (side >= 2) std::ranges::reverse(nodes);
  return nodes;
}

struct Side {
  std::size_t patch, side;
  std::vector<Node> node;  ///< of the atlas
  std::vector<Point> place;
};

std::string name_of(const std::vector<Atlas::Patch>& patches, const Side& s) {
  return patches[s.patch].name + "." + side_names[s.side];
}

/// A node of the border of a patch, by its number among all nodes of all patches.
struct BorderNode {
  Node number;
  Point place;
};

void unite_near(std::vector<BorderNode>& border, double distance, Unions& unions) {
  std::ranges::sort(border, {}, [](const BorderNode& b) { return b.place[0]; });
  for (std::size_t a = 0; a < border.size(); ++a)
    for (std::size_t b = a + 1; b < border.size() && border[b].place[0] - border[a].place[0] <= distance; ++b)
      if (length(difference(border[a].place, border[b].place)) <= distance)
        unions.unite(border[a].number, border[b].number);
}

void require_sheets(const std::vector<Atlas::Patch>& patches) {
  if (patches.empty()) throw Error(Fault::input, "there is no patch");
  for (const Atlas::Patch& p : patches) {
    require_sound(p.grid);
    if (p.grid.dimension() != 2 || p.grid.periodic != std::array<bool, 3>{})
      throw Error(Fault::input, "the patch " + p.name + " is no sheet with four sides");
  }
}

double diagonal_of(const std::vector<Atlas::Patch>& patches) {
  Box box;
  for (const Atlas::Patch& p : patches)
    for (Node v = 0; v < static_cast<Node>(p.grid.nodes()); ++v) box.add(p.grid.point(v));
  return box.diagonal();
}

/// Numbers the nodes of the atlas in the order of the patches.
void number_nodes(Atlas& atlas, double distance) {
  std::vector<Node> first{0};
  for (const Atlas::Patch& p : atlas.patches) first.push_back(first.back() + static_cast<Node>(p.grid.nodes()));
  Unions unions(static_cast<std::size_t>(first.back()));
  std::vector<BorderNode> border;
  for (std::size_t p = 0; p < atlas.patches.size(); ++p)
    for (std::size_t side = 0; side < 4; ++side)
      for (const Node v : side_nodes(atlas.patches[p].grid, side))
        border.push_back({first[p] + v, atlas.patches[p].grid.point(v)});
  unite_near(border, distance, unions);
  std::vector<Node> number(static_cast<std::size_t>(first.back()), -1);
  for (std::size_t p = 0; p < atlas.patches.size(); ++p)
    for (Node v = first[p]; v < first[p + 1]; ++v) {
      Node& n = number[static_cast<std::size_t>(unions.root(v))];
      if (n < 0) n = atlas.nodes++;
      atlas.patches[p].node.push_back(n);
    }
}

std::vector<Side> sides_of(const std::vector<Atlas::Patch>& patches) {
  std::vector<Side> sides;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t s = 0; s < 4; ++s) {
      Side side{p, s, {}, {}};
      for (const Node v : side_nodes(patches[p].grid, s)) {
        side.node.push_back(patches[p].node[static_cast<std::size_t>(v)]);
        side.place.push_back(patches[p].grid.point(v));
      }
      sides.push_back(std::move(side));
    }
  return sides;
}

bool has_length(const Side& s) {
  return std::ranges::any_of(s.node, [&](Node n) { return n != s.node[0]; });
}

double length_of(const Side& s) {
  double sum = 0;
  for (std::size_t k = 1; k < s.place.size(); ++k) sum += length(difference(s.place[k], s.place[k - 1]));
  return sum;
}

/// The largest distance of the nodes of one from the course of the other, a polyline.
double largest_distance(const Side& of, const Side& from) {
  double largest = 0;
  for (const Point& p : of.place) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < from.place.size(); ++k) {
      const Point &a = from.place[k - 1], step = difference(from.place[k], a), way = difference(p, a);
      const double square = dot(step, step), t = square > 0 ? std::clamp(dot(way, step) / square, 0.0, 1.0) : 0;
      least = std::min(least, length(difference(way, {t * step[0], t * step[1], t * step[2]})));
    }
    largest = std::max(largest, least);
  }
  return largest;
}

bool same_ends(const Side& a, const Side& b) {
  const std::array ends = {b.node.front(), b.node.back()};
  return (a.node.front() == ends[0] && a.node.back() == ends[1]) ||
         (a.node.front() == ends[1] && a.node.back() == ends[0]);
}

bool same_nodes(const Side& a, const Side& b) {
  return a.node == b.node || std::equal(a.node.begin(), a.node.end(), b.node.rbegin(), b.node.rend());
}

/// Of two sides that were not meant to lie so.
void require_match(const std::vector<Atlas::Patch>& patches, const Side& a, const Side& b) {
  if (!has_length(a) || !has_length(b) || same_nodes(a, b)) return;
  const std::string names = name_of(patches, a) + " and " + name_of(patches, b);
  // Of two polylines along one curve the chords miss it by some percent of an edge.
  constexpr double near = 0.02;
  if (same_ends(a, b) && largest_distance(a, b) < near * length_of(a) && largest_distance(b, a) < near * length_of(a))
    throw Error(Fault::input, "the sides " + names +
                                  " run along each other but do not match: " + std::to_string(a.node.size()) + " and " +
                                  std::to_string(b.node.size()) + " nodes; give both the same number, equally spaced");
  std::vector<Node> first = a.node, second = b.node, common;
  std::ranges::sort(first);
  std::ranges::sort(second);
  std::ranges::set_intersection(first, second, std::back_inserter(common));
  common.erase(std::unique(common.begin(), common.end()), common.end());
  if (common.size() > 2)
    throw Error(Fault::input,
                "the sides " + names + " meet along a part of their length only; cut the longer patch in two");
}

/// All pairs of sides that have a node in common; others cannot run along each other.
void require_matches(const std::vector<Atlas::Patch>& patches, const std::vector<Side>& sides) {
  std::unordered_map<Node, std::vector<std::size_t>> at_node;
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const Node n : sides[s].node)
      if (auto& list = at_node[n]; list.empty() || list.back() != s) list.push_back(s);
  std::vector<std::size_t> others;
  for (std::size_t a = 0; a < sides.size(); ++a) {
    others.clear();
    for (const Node n : sides[a].node)
      for (const std::size_t b : at_node[n])
        if (b > a) others.push_back(b);
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const std::size_t b : others) require_match(patches, sides[a], sides[b]);
  }
}

/// Edges of the borders, each by its smaller node first.
using Edge = std::pair<Node, Node>;
struct EdgeUse {
  std::size_t patch;
  bool forward;  ///< counter-clockwise around the patch from the smaller node
};

std::map<Edge, std::vector<EdgeUse>> border_edges(const std::vector<Side>& sides) {
  std::map<Edge, std::vector<EdgeUse>> edges;
  for (const Side& s : sides)
    for (std::size_t k = 1; k < s.node.size(); ++k)
      if (const Node a = s.node[k - 1], b = s.node[k]; a != b)
        edges[{std::min(a, b), std::max(a, b)}].push_back({s.patch, a < b});
  return edges;
}

/// Turns patches until neighbours agree; then the whole, if a closed surface has its inside out.
void find_outside(Atlas& atlas, const std::map<Edge, std::vector<EdgeUse>>& edges) {
  struct Link {
    std::size_t other;
    bool differ;
  };
  std::vector<std::vector<Link>> links(atlas.patches.size());
  for (const auto& [edge, uses] : edges)
    if (uses.size() == 2) {
      const bool differ = uses[0].forward == uses[1].forward;
      links[uses[0].patch].push_back({uses[1].patch, differ});
      links[uses[1].patch].push_back({uses[0].patch, differ});
    }
  std::vector<char> known(atlas.patches.size(), 0);
  for (std::size_t seed = 0; seed < known.size(); ++seed) {
    std::vector<std::size_t> open;
    if (!known[seed]) open.push_back(seed);
    known[seed] = 1;
    while (!open.empty()) {
      const std::size_t p = open.back();
      open.pop_back();
      for (const Link& link : links[p]) {
        const bool turned = atlas.patches[p].turned != link.differ;
        if (known[link.other]) {
          atlas.one_sided |= atlas.patches[link.other].turned != turned;
          continue;
        }
        atlas.patches[link.other].turned = turned;
        known[link.other] = 1;
        open.push_back(link.other);
      }
    }
  }
}

/// Six times the volume to the left of the triangles, from the first vertex.
double signed_volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) {
      return difference(mesh.points[static_cast<std::size_t>(t[k])], mesh.points[0]);
    };
    sum += dot(at(0), cross(at(1), at(2)));
  }
  return sum;
}

}  // namespace

Atlas sew(std::vector<Atlas::Patch> patches) {
  require_sheets(patches);
  constexpr double near = 1e-9;
  Atlas atlas;
  atlas.patches = std::move(patches);
  number_nodes(atlas, near * diagonal_of(atlas.patches));
  const std::vector<Side> sides = sides_of(atlas.patches);
  require_matches(atlas.patches, sides);
  const auto edges = border_edges(sides);
  bool closed = true;
  for (const auto& [edge, uses] : edges) {
    closed &= uses.size() == 2;
    if (uses.size() > 2)
      throw Error(Fault::input, "the patches " + atlas.patches[uses[0].patch].name + ", " +
                                    atlas.patches[uses[1].patch].name + " and " + atlas.patches[uses[2].patch].name +
                                    " share an edge; only two can");
  }
  find_outside(atlas, edges);
  if (closed && !atlas.one_sided && signed_volume(mesh_of(atlas)) < 0)
    for (Atlas::Patch& p : atlas.patches) p.turned = !p.turned;
  return atlas;
}

TriangleMesh mesh_of(const Atlas& atlas) {
  TriangleMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(atlas.nodes));
  mesh.metres_per_unit = atlas.metres_per_unit;
  for (const Atlas::Patch& p : atlas.patches)
    for (std::size_t v = 0; v < p.node.size(); ++v)
      mesh.points[static_cast<std::size_t>(p.node[v])] = p.grid.point(static_cast<Node>(v));
  for_triangles(atlas, [&](std::size_t patch, Triangle t) {
    for (Node& v : t) v = atlas.patches[patch].node[static_cast<std::size_t>(v)];
    mesh.triangles.push_back(t);
  });
  return mesh;
}

void for_triangles(const Atlas& atlas, const std::function<void(std::size_t, const Triangle&)>& use) {
  for (std::size_t p = 0; p < atlas.patches.size(); ++p) {
    const Atlas::Patch& patch = atlas.patches[p];
    Grid plain = patch.grid;
    plain.attributes.clear();
    for (Triangle t : mesh_of(plain).triangles) {
      const auto node = [&](std::size_t k) { return patch.node[static_cast<std::size_t>(t[k])]; };
      if (node(0) == node(1) || node(1) == node(2) || node(2) == node(0)) continue;
      if (patch.turned) std::swap(t[1], t[2]);
      use(p, t);
    }
  }
}

std::vector<double> on_patch(const Atlas::Patch& patch, const std::vector<double>& values, std::size_t components) {
  std::vector<double> result;
  result.reserve(components * patch.node.size());
  for (const Node n : patch.node)
    for (std::size_t k = 0; k < components; ++k) result.push_back(values[components * static_cast<std::size_t>(n) + k]);
  return result;
}

}  // namespace pelage

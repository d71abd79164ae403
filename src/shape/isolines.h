#pragma once
// Surfaces cut along the lines where a function at their vertices is 0, and these lines as chains.
//
// The lines cross triangles straight, from edge to edge. Triangles that share an edge share the place where a line
// crosses it, so that chains have no gaps and parts no T-junctions.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// (1 - t) a + t b of two vertices; a vertex itself where they are the same.
struct CrossedEdge {
  std::int32_t a = 0, b = 0;
  double t = 0;

  bool operator==(const CrossedEdge&) const = default;
};

/// A part of a triangulated surface. What its borders are is noted at its triangles: of the edge from corner k on 0
/// inside, otherwise a mark, 1 for a border that the surface had before it was cut.
struct SurfacePart {
  std::vector<Triangle> triangles;
  std::vector<std::array<std::uint8_t, 3>> border;  ///< per triangle
  std::vector<std::int32_t> face;                   ///< per triangle: the one of the whole surface that it lies in
  std::vector<CrossedEdge> vertices;                ///< on the surface that was cut last
};

inline constexpr std::uint8_t own_border = 1;

/// All of a surface.
SurfacePart whole_surface(const std::vector<Triangle>& triangles, std::size_t vertex_count);

/// The place between two vertices, the first one inside, where an edge crosses the line: t of CrossedEdge.
using Crossing = std::function<double(std::int32_t inside, std::int32_t outside)>;

/// The part where the values, one for each vertex of `of`, are above 0; new borders get the mark. Triangles keep their
/// orientation, vertices inside come first and in their order. Vertices are places on `of`. Where a line passes through
/// a vertex, places fall together there, and triangles may be without area.
SurfacePart part_above(const SurfacePart& of, std::span<const double> values, std::uint8_t mark);
/// The same for what is known as inside (not 0) or outside alone.
SurfacePart part_inside(const SurfacePart& of, std::span<const char> inside, const Crossing& crossing,
                        std::uint8_t mark);

/// A line along vertices; the first one is not repeated at the end of a closed one.
struct Chain {
  std::vector<std::int32_t> vertices;
  bool closed = false;
};

/// The borders with a mark for which `wanted` holds, joined as far as they go on, with the part to their left. Where
/// more than two meet, one of them goes on.
std::vector<Chain> border_chains(const SurfacePart& part, const std::function<bool(std::uint8_t)>& wanted);

/// Values of the surface that was cut, at the vertices of the part: numbers, or points.
double between(double a, double b, double t);
Point between(const Point& a, const Point& b, double t);
template <class Value>
std::vector<Value> values_on(const SurfacePart& part, const std::vector<Value>& values) {
  std::vector<Value> result;
  result.reserve(part.vertices.size());
  for (const CrossedEdge& p : part.vertices)
    result.push_back(p.a == p.b
                         ? values[static_cast<std::size_t>(p.a)]
                         : between(values[static_cast<std::size_t>(p.a)], values[static_cast<std::size_t>(p.b)], p.t));
  return result;
}

}  // namespace pelage

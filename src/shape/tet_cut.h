#pragma once
// What is left of a volume where parts of it are cut away: its closed surface.

#include <cstdint>
#include <span>
#include <vector>

#include "pelage/grid.h"
#include "pelage/tet_mesh.h"

namespace pelage {

/// Values at all nodes, linear within tetrahedra; what is below 0 is cut away, or, where `and_next`, only what is below
/// 0 for the next cut as well.
struct Cut {
  std::vector<double> values;
  /// Whether they are linear in space: the cut then goes through nodes where it meets them. Else it keeps a hundredth
  /// of an edge from them, so that it is a surface without pinches for any values, and its triangles, if slim, have
  /// areas.
  bool plane = false;
  bool and_next = false;
};

/// The plane where `normal` . x = `offset`; what is cut away lies to where the normal points.
Cut plane_cut(const std::vector<Point>& nodes, const Point& normal, double offset);

/// What lies where the values are below the level.
Cut level_cut(const std::vector<double>& values, double level);

/// A surface whose vertices lie at nodes of a volume or on the way between two earlier ones.
class CarvedBody {
 public:
  std::vector<Triangle> triangles;  ///< counter-clockwise from outside
  std::vector<std::uint8_t> side;   ///< per triangle: 0 on the skin of the volume, k on the k-th cut, from 1

  std::size_t vertices() const { return vertex_.size(); }
  /// What nodes have (`components` numbers each), at the vertices.
  std::vector<double> at_vertices(const std::vector<double>& at_nodes, std::size_t components) const;
  /// An attribute of nodes: names and what is there once per node is that of the nearer one.
  Attribute at_vertices(const Attribute& attribute) const;
  std::vector<Point> places(const std::vector<Point>& nodes) const;

  /// Splits every triangle into four, flat.
  void refine();

 private:
  friend class Carver;
  /// A part of the way from one vertex to another.
  struct Way {
    std::int32_t from, to;
    double part;
  };
  std::int32_t nodes_ = 0;            ///< of the volume; they are the first vertices
  std::vector<Way> ways_;             ///< to the vertices behind them
  std::vector<std::int32_t> vertex_;  ///< those in use: what `triangles` count
};

/// The surface of what the cuts leave of a volume: of its skin where it is left, and of the cuts. Closed where the skin
/// is, since neighbours are cut alike; without triangles where nothing is left. At most 255 cuts.
CarvedBody carve(const TetMesh& volume, std::span<const Cut> cuts);

/// The same of a block between its nodes, whose cells are six tetrahedra each (Kuhn 1960). Periodic axes end at the
/// first and the last node.
CarvedBody carve(const Grid& block, std::span<const Cut> cuts);

}  // namespace pelage

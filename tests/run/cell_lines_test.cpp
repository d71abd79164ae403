#include "run/cell_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/box.h"
#include "shape/cell_neighbours.h"
#include "shape/cells.h"
#include "shape/generators.h"
#include "shape/point_index.h"
#include "support/soups.h"

namespace pelage {
namespace {

Point tangential(const Point& v, const Point& normal) {
  const double along = dot(v, normal);
  return unit({v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]});
}

/// Cosine of the angle between a line and that of a neighbour, unfolded into its plane; the smallest share of pairs
/// below `limit`.
double share_of_turns(const Cells& cells, const std::vector<Point>& lines, double limit) {
  const CellNeighbours all(cells.points, cells.normals, cells.radius);
  double turned = 0, pairs = 0;
  std::vector<CellNeighbour> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    all.find(i, 0.7 * cells.radius, found);
    for (const CellNeighbour& n : found) {
      const auto j = static_cast<std::size_t>(n.cell);
      turned += std::abs(dot(lines[i], turned_into(lines[j], cells.normals[j], cells.normals[i]))) < limit;
      ++pairs;
    }
  }
  return turned / pairs;
}

/// A torus has a field without singularities, a sphere has four of half a turn.
TEST(CellLines, TheSmoothestFieldHasNoMoreSingularitiesThanItMust) {
  const Cells torus = make_cells(shared(builtin_shape("builtin:torus?n=5000")), 2000);
  EXPECT_LT(share_of_turns(torus, completed_lines(torus, {}), std::cos(0.5)), 1e-3);
  const Cells sphere = make_cells(shared(builtin_shape("builtin:sphere?n=5000")), 2000);
  const double share = share_of_turns(sphere, completed_lines(sphere, {}), std::cos(0.5));
  EXPECT_GT(share, 1e-4);
  EXPECT_LT(share, 0.02);
}

/// On a flat sheet, over its cracks, all follow the few that have a direction.
TEST(CellLines, FollowTheFewThatAreGiven) {
  const Cells cells = make_cells(shared(square_with_t_junctions()), 600);
  std::vector<Point> given(cells.nodes(), Point{});
  given[5] = {1, 2, 0.3};
  const Point line = unit({1, 2, 0});
  for (const Point& d : completed_lines(cells, given)) EXPECT_NEAR(std::abs(dot(d, line)), 1, 1e-4);
}

/// Root mean square over all cells of the sine of the angle to the lines of a mesh at its nearest vertices.
double difference_to_mesh(const TriangleMesh& mesh, const std::vector<Point>& directions, const Cells& cells,
                          const std::vector<Point>& lines) {
  const PointIndex vertices(mesh.points, cells.radius);
  double sum = 0;
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    std::size_t v = 0;
    double least = cells.radius * cells.radius;
    vertices.for_each_within(cells.points[i], cells.radius, [&](std::int32_t j, double square) {
      if (square > least) return;
      least = square;
      v = static_cast<std::size_t>(j);
    });
    EXPECT_NEAR(length(lines[i]), 1, 1e-9);
    EXPECT_NEAR(dot(lines[i], cells.normals[i]), 0, 1e-9);
    const Point there = tangential(directions[v], cells.normals[i]);
    sum += std::pow(length(cross(lines[i], there)), 2) / static_cast<double>(cells.nodes());
  }
  return std::sqrt(sum);
}

template <class Where>
std::vector<Index> marked(const std::vector<Point>& points, const Where& where) {
  std::vector<Index> list;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (where(points[i])) list.push_back(static_cast<Index>(i));
  return list;
}

/// Whatever is wished, cells on the polygons of a mesh and on its points alone follow it as the mesh does.
TEST(CellLines, WishesMeanWhatTheyMeanOnMeshes) {
  const TriangleMesh torus = builtin_shape("builtin:torus?n=4000");  // around z
  const Connection c = make_connection(make_topology(torus.points.size(), torus.triangles), torus.points);
  const double diagonal = box_of(torus.points).diagonal();
  std::map<std::string, FieldWish> wishes;
  wishes["axis"].axis = Point{1, 0, 0};
  wishes["centre"].centre = Point{0.3, 0.2, 2};
  wishes["curvature"].curvature = wishes["curvature"].across = true;
  wishes["way"].from = wishes["way"].to = {0};
  std::vector<Point> stroke;
  for (int k = 0; k <= 10; ++k) stroke.push_back({std::cos(0.1 * k), std::sin(0.1 * k), 0.3});
  wishes["strokes"].strokes = {stroke};
  wishes["strokes"].axis = Point{1, 0, 0};
  const Cells on_polygons = make_cells(shared(torus), 2000), on_points = make_cells(shared(cloud_of(torus)), 2000);
  for (auto& [name, wish] : wishes) {
    wish.smooth = 0.05 * diagonal;
    const auto here = [&](const std::vector<Point>& points) {
      FieldWish w = wish;
      if (!w.from.empty()) w.from = marked(points, [](const Point& p) { return p[0] < -1.1; });
      if (!w.to.empty()) w.to = marked(points, [](const Point& p) { return p[0] > 1.1; });
      return w;
    };
    const auto directions = direction_field(c, 2, find_guides(here(torus.points), c, torus.points, diagonal)).direction;
    for (const Cells* cells : {&on_polygons, &on_points}) {
      const double off = difference_to_mesh(torus, directions, *cells, wished_lines(*cells, here(cells->points)));
      RecordProperty(name, std::to_string(off));
      EXPECT_LT(off, 0.1) << name;  // the way has places where it does not know where to go
    }
  }
}

}  // namespace
}  // namespace pelage

#include "look/cell_picture.h"

#include <array>

#include "shape/cell_outlines.h"

namespace pelage {

namespace {

using Color = std::array<double, 3>;

constexpr Color seam = {0.02, 0.02, 0.025}, few = {0.1, 0.28, 0.55}, six = {0.75, 0.7, 0.6}, many = {0.62, 0.13, 0.08};
constexpr double inside = 0.9, dot = 0.13;  // shares of the way from the point to the corners

class Drawing {
 public:
  explicit Drawing(const Cells& cells) : cells_(cells) {}

  /// The ring between two shares of the way to the corners, or all from the point.
  void ring(std::size_t cell, const std::vector<Point>& corners, double from, double to, const Color& color) {
    const std::size_t n = corners.size();
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (const double share : {from, to})
      for (const Point& corner : corners) {
        Point p = cells_.points[cell];
        for (std::size_t k = 0; k < 3; ++k) p[k] += share * (corner[k] - p[k]);
        mesh.points.push_back(p);
        colors_.insert(colors_.end(), color.begin(), color.end());
        normals_.insert(normals_.end(), cells_.normals[cell].begin(), cells_.normals[cell].end());
      }
    for (std::size_t k = 0; k < n; ++k) {
      const auto a = first + static_cast<std::int32_t>(k), b = first + static_cast<std::int32_t>((k + 1) % n),
                 step = static_cast<std::int32_t>(n);
      if (from > 0) mesh.triangles.push_back({a, a + step, b});
      mesh.triangles.push_back({b, a + step, b + step});
    }
  }

  TriangleMesh finish() {
    mesh.set({"normal", 3, Domain::vertex, std::move(normals_)});
    mesh.set({"color", 3, Domain::vertex, std::move(colors_)});
    return std::move(mesh);
  }

  TriangleMesh mesh;

 private:
  const Cells& cells_;
  std::vector<double> colors_, normals_;
};

}  // namespace

TriangleMesh cells_to_see(const Cells& cells) {
  const PolygonMesh outlines = outlines_of(cells);
  const std::vector<double>& sides = outlines.find("sides")->values;
  Drawing drawing(cells);
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    std::vector<Point> corners;
    for (std::size_t c = outlines.face_begin(i); c < outlines.face_ends[i]; ++c)
      corners.push_back(outlines.points[static_cast<std::size_t>(outlines.corners[c])]);
    drawing.ring(i, corners, 0, dot, seam);
    drawing.ring(i, corners, dot, inside, sides[i] < 6 ? few : sides[i] > 6 ? many : six);
    drawing.ring(i, corners, inside, 1, seam);
  }
  return drawing.finish();
}

}  // namespace pelage

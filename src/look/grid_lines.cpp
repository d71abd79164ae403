#include "look/grid_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.h"
#include "look/canvas.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

const Color line_color = {0.03, 0.10, 0.22}, border_color = {0.005, 0.01, 0.02}, white = {1, 1, 1};

/// Node numbers along a line of a grid.
struct GridLine {
  std::vector<std::int32_t> nodes;
  bool border = false;
};

/// The lines along an axis, on the sheets in which the other axes lie.
void add_lines(const Grid& grid, std::size_t axis, std::vector<GridLine>& lines) {
  const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
  const auto outer = [&](std::size_t k, std::int32_t i) {
    return grid.count[k] > 1 && !grid.periodic[k] && (i == 0 || i == grid.count[k] - 1);
  };
  for (std::int32_t i = 0; i < grid.count[b]; ++i)
    for (std::int32_t j = 0; j < grid.count[c]; ++j) {
      if (grid.dimension() == 3 && !outer(b, i) && !outer(c, j)) continue;
      GridLine line{{}, grid.dimension() == 3 ? outer(b, i) && outer(c, j) : outer(b, i) || outer(c, j)};
      std::array<std::int32_t, 3> place{};
      place[b] = i;
      place[c] = j;
      for (place[axis] = 0; place[axis] < grid.count[axis]; ++place[axis])
        line.nodes.push_back(grid.node(place[0], place[1], place[2]));
      if (grid.periodic[axis] && !grid.even() && grid.period[axis] == Point{}) line.nodes.push_back(line.nodes[0]);
      lines.push_back(std::move(line));
    }
}

/// The plane of the picture, right and up.
struct View {
  Point right = {1, 0, 0}, up = {0, 1, 0};
};

View view_of(const Box& box) {
  if (!(box.high[2] - box.low[2] > 1e-9 * box.diagonal())) return {};
  constexpr double turn = -35 * std::numbers::pi / 180, tilt = 30 * std::numbers::pi / 180;
  return {{std::cos(turn), -std::sin(turn), 0},
          {std::sin(tilt) * std::sin(turn), std::sin(tilt) * std::cos(turn), std::cos(tilt)}};
}

}  // namespace

Image grid_lines_picture(const Grid& grid, int size) {
  std::vector<Point> points;
  for (std::size_t v = 0; v < grid.nodes(); ++v) points.push_back(grid.point(static_cast<std::int32_t>(v)));
  const View view = view_of(box_of(points));
  for (Point& p : points) p = {dot(p, view.right), dot(p, view.up), 0};
  const Box box = box_of(points);
  const double width = box.high[0] - box.low[0], height = box.high[1] - box.low[1], margin = std::max(4.0, size / 50.0);
  const double scale = (size - 2 * margin) / std::max(width, height);
  const auto pixels = [&](double extent) { return static_cast<int>(std::ceil(extent * scale + 2 * margin)); };
  Canvas canvas(pixels(width), pixels(height), white);
  std::vector<GridLine> lines;
  for (int axis = 0; axis < grid.dimension(); ++axis) add_lines(grid, static_cast<std::size_t>(axis), lines);
  std::stable_partition(lines.begin(), lines.end(), [](const GridLine& line) { return !line.border; });
  for (const GridLine& line : lines) {
    std::vector<Spot> spots;
    for (const std::int32_t v : line.nodes) {
      const Point& p = points[static_cast<std::size_t>(v)];
      spots.push_back({margin + (p[0] - box.low[0]) * scale, margin + (box.high[1] - p[1]) * scale});
    }
    canvas.line(spots, line.border ? std::max(1.6, size / 500.0) : std::max(0.8, size / 1000.0),
                line.border ? border_color : line_color);
  }
  return canvas.image();
}

Image grid_lines_sheet(const std::vector<NamedGrid>& grids, int columns, int tile) {
  const int rows = (static_cast<int>(grids.size()) + columns - 1) / columns, label = tile / 10;
  Canvas canvas(columns * tile, rows * tile, white);
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const int left = static_cast<int>(k) % columns * tile, top = static_cast<int>(k) / columns * tile;
    const Image picture = grid_lines_picture(grids[k].grid, tile - label);
    canvas.text(grids[k].name, {left + tile / 2.0, top + 0.8 * label}, {0.8 * label, border_color, Align::centre});
    canvas.picture(picture, left + (tile - picture.width) / 2, top + label + (tile - label - picture.height) / 2);
  }
  return canvas.image();
}

}  // namespace pelage

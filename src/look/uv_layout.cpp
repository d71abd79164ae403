#include "look/uv_layout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "shape/vectors.h"

namespace pelage {

namespace {

using Place2 = std::array<double, 2>;
using Corners2 = std::array<Place2, 3>;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// A face that reaches over more repeats of an image than this is none that shows it.
constexpr double most_repeats = 32;

/// Smaller copies of an image halve it; so many texels keep charts apart in all of them that have eight texels and more
/// to a sixteenth of the image.
int gutter_of(int size) { return std::max(2, (size + 127) / 128); }

double twice_area(const Corners2& c) {
  return (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[2][0] - c[0][0]) * (c[1][1] - c[0][1]);
}

/// Of the corners, along an axis.
std::pair<double, double> range(const Corners2& c, std::size_t axis) {
  return std::minmax({c[0][axis], c[1][axis], c[2][axis]});
}

/// The tile of a face that lies in a single one, up to rounding of its uv.
std::array<int, 2> tile_around(const Corners2& c) {
  std::array<int, 2> tile;
  for (std::size_t k = 0; k < 2; ++k)
    tile[k] = static_cast<int>(std::clamp(std::floor((c[0][k] + c[1][k] + c[2][k]) / 3), -1e6, 1e6));
  return tile;
}

bool is_in_one_tile(const Corners2& c) {
  constexpr double rounding = 1e-4;  // programs that pack charts put some on the very border
  const std::array<int, 2> tile = tile_around(c);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto [low, high] = range(c, k);
    if (low < tile[k] - rounding || high > tile[k] + 1 + rounding) return false;
  }
  return true;
}

/// Tiles are numbered in rows of ten.
bool has_number(const std::array<int, 2>& tile) {
  return tile[0] >= 0 && tile[0] < 10 && tile[1] >= 0 && tile[1] < 900;
}

int number_of(const std::array<int, 2>& tile) { return 1001 + tile[0] + 10 * tile[1]; }

std::vector<Corners2> uv_of_faces(const std::vector<Triangle>& triangles, const Attribute& uv) {
  std::vector<Corners2> faces(triangles.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t tuple = uv.domain == Domain::corner ? 3 * f + k : at(triangles[f][k]);
      faces[f][k] = {uv.values[2 * tuple], uv.values[2 * tuple + 1]};
    }
  return faces;
}

/// Which edges of the faces are borders of charts: those with no face beyond that goes on in the image.
std::vector<std::array<bool, 3>> borders_of(const std::vector<Triangle>& triangles, const std::vector<Corners2>& uv) {
  using Edge = std::tuple<std::int32_t, std::int32_t, Place2, Place2>;
  std::vector<std::pair<Edge, std::size_t>> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const std::int32_t a = triangles[f][k], b = triangles[f][next];
      edges.emplace_back(a < b ? Edge(a, b, uv[f][k], uv[f][next]) : Edge(b, a, uv[f][next], uv[f][k]), 3 * f + k);
    }
  std::ranges::sort(edges);
  std::vector<std::array<bool, 3>> border(triangles.size(), {true, true, true});
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].first == edges[i - 1].first)
      for (const std::size_t e : {edges[i].second, edges[i - 1].second}) border[e / 3][e % 3] = false;
  return border;
}

}  // namespace

void UvLayout::note(UvNote::Kind kind, Index face) {
  const auto found = std::ranges::find(notes_, kind, &UvNote::kind);
  if (found == notes_.end())
    notes_.push_back({kind, 1, face});
  else
    ++found->count;
}

UvLayout::UvLayout(const std::vector<Triangle>& triangles, const Attribute& uv, int size)
    : size_(size), gutter_(gutter_of(size)), tile_of_face_(triangles.size(), 0) {
  const std::vector<Corners2> faces = uv_of_faces(triangles, uv);
  std::map<int, std::size_t> number_of_tile;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (is_in_one_tile(faces[f]) && has_number(tile_around(faces[f]))) {
      number_of_tile[number_of(tile_around(faces[f]))] = 0;
    } else {
      note(UvNote::Kind::outside, static_cast<Index>(f));
      repeats_ = true;
    }
  }
  if (repeats_ || number_of_tile.empty()) number_of_tile = {{1001, 0}};
  for (auto& [number, index] : number_of_tile) {
    index = tiles_.size();
    tiles_.push_back(number);
  }
  placed_.resize(tiles_.size());
  const std::vector<std::array<bool, 3>> border = borders_of(triangles, faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double area = twice_area(faces[f]);
    if (area == 0) note(UvNote::Kind::degenerate, static_cast<Index>(f));
    if (area < 0) note(UvNote::Kind::mirrored, static_cast<Index>(f));
    if (!repeats_) {
      const std::array<int, 2> tile = tile_around(faces[f]);
      tile_of_face_[f] = number_of_tile.at(number_of(tile));
    }
    if (area != 0) place(static_cast<Index>(f), faces[f], border[f]);
  }
  sort_into_bands();
}

/// In every repeat of the image that its gutter reaches.
void UvLayout::place(Index face, const Corners2& uv, const std::array<bool, 3>& border) {
  const std::array<int, 2> own = tile_around(uv);
  std::array<int, 2> first = own, last = own;
  for (std::size_t k = 0; repeats_ && k < 2; ++k) {
    const auto [low, high] = range(uv, k);
    const double reach = static_cast<double>(gutter_) / size_;
    if (high - low > most_repeats) return;
    first[k] = static_cast<int>(std::floor(low - reach));
    last[k] = static_cast<int>(std::floor(high + reach));
  }
  for (int j = first[1]; j <= last[1]; ++j)
    for (int i = first[0]; i <= last[0]; ++i) {
      Placed p{face, {}, border};
      for (std::size_t k = 0; k < 3; ++k) p.corner[k] = {(uv[k][0] - i) * size_, (1 - (uv[k][1] - j)) * size_};
      placed_[tile_of(face)].push_back(p);
    }
}

void UvLayout::sort_into_bands() {
  for (const std::vector<Placed>& faces : placed_) {
    auto& bands = in_band_.emplace_back(at((size_ + band - 1) / band));
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto [low, high] = range(faces[i].corner, 1);
      const int first = std::max(0, static_cast<int>(std::floor(low)) - gutter_) / band;
      const int last = std::min(size_ - 1, static_cast<int>(std::floor(high)) + gutter_) / band;
      for (int b = first; b <= last && high + gutter_ >= 0; ++b) bands[at(b)].push_back(static_cast<std::int32_t>(i));
    }
  }
}

MeshPlace UvLayout::Placed::place(double x, double y) const {
  const Place2 &a = corner[0], &b = corner[1], &c = corner[2];
  const double dx = x - a[0], dy = y - a[1], area = twice_area(corner);
  return {face, (dx * (c[1] - a[1]) - dy * (c[0] - a[0])) / area, (dy * (b[0] - a[0]) - dx * (b[1] - a[1])) / area};
}

// --- texels --------------------------------------------------------------------------------------------

namespace {

double square_of_distance(double x, double y, const Place2& a, const Place2& b) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], length = ux * ux + uy * uy;
  const double t = length > 0 ? std::clamp(((x - a[0]) * ux + (y - a[1]) * uy) / length, 0.0, 1.0) : 0;
  const double dx = a[0] + t * ux - x, dy = a[1] + t * uy - y;
  return dx * dx + dy * dy;
}

}  // namespace

/// Some rows of a tile while faces are laid into them.
struct UvLayout::Rows {
  struct Cell {
    const Placed* shows = nullptr;
    double square = 0;     ///< of the distance to what is shown
    bool well_in = false;  ///< not on an edge, where faces meet
  };
  int size, first, last;
  std::vector<Cell> cells = std::vector<Cell>(at(std::int64_t{size} * (last - first)));

  /// Calls visit(x, y, cell) for the texels whose middles lie in a box.
  template <class Visit>
  void each(double left, double right, double top, double bottom, Visit&& visit) {
    const auto texel = [&](double x) { return static_cast<int>(std::clamp(x, -1.0, size + 1.0)); };
    const int x0 = std::max(0, texel(std::ceil(left - 0.5))), x1 = std::min(size - 1, texel(std::floor(right - 0.5)));
    const int y0 = std::max(first, texel(std::ceil(top - 0.5))),
              y1 = std::min(last - 1, texel(std::floor(bottom - 0.5)));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) visit(x + 0.5, y + 0.5, cells[at(std::int64_t{y - first} * size + x)]);
  }

  void lay(const Placed& face, std::vector<Index>& hidden) {
    constexpr double rounding = 1e-9, edge = 1e-3;
    const auto [left, right] = range(face.corner, 0);
    const auto [top, bottom] = range(face.corner, 1);
    bool hides = false;
    each(left - rounding, right + rounding, top - rounding, bottom + rounding, [&](double x, double y, Cell& cell) {
      const auto [f, v, w] = face.place(x, y);
      const double least = std::min({v, w, 1 - v - w});
      if (least < -rounding) return;
      if (!cell.shows)
        cell = {&face, 0, least > edge};
      else if (cell.shows->face != face.face)
        hides |= cell.well_in && least > edge;
    });
    if (hides) hidden.push_back(face.face);
  }

  void surround(const Placed& face, double gutter) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!face.border[k]) continue;
      const Place2 &a = face.corner[k], &b = face.corner[(k + 1) % 3];
      each(std::min(a[0], b[0]) - gutter, std::max(a[0], b[0]) + gutter, std::min(a[1], b[1]) - gutter,
           std::max(a[1], b[1]) + gutter, [&](double x, double y, Cell& cell) {
             if (cell.shows && cell.square == 0) return;
             const double square = square_of_distance(x, y, a, b);
             if (square <= gutter * gutter && (!cell.shows || square < cell.square)) cell = {&face, square, false};
           });
    }
  }
};

std::vector<UvLayout::Texel> UvLayout::texels(std::size_t tile, int first_row, int last_row,
                                              std::vector<Index>& hidden) const {
  Rows rows{size_, first_row, last_row};
  const auto each_face = [&](const auto& visit) {
    std::int32_t before = -1;
    std::vector<std::int32_t> faces;
    for (int b = first_row / band; b <= (last_row - 1) / band; ++b)
      faces.insert(faces.end(), in_band_[tile][at(b)].begin(), in_band_[tile][at(b)].end());
    std::ranges::sort(faces);
    for (const std::int32_t i : faces)
      if (std::exchange(before, i) != i) visit(placed_[tile][at(i)]);
  };
  each_face([&](const Placed& face) { rows.lay(face, hidden); });
  each_face([&](const Placed& face) { rows.surround(face, gutter_); });
  std::vector<Texel> result;
  for (std::size_t i = 0; i < rows.cells.size(); ++i)
    if (const Rows::Cell& cell = rows.cells[i]; cell.shows)
      result.push_back(
          {static_cast<int>(i % at(size_)), first_row + static_cast<int>(i / at(size_)), cell.shows, cell.square == 0});
  return result;
}

// --- sizes ---------------------------------------------------------------------------------------------

namespace {

/// The largest singular value of the map from uv to the surface, and the area there.
struct Stretch {
  double longest, area;
};
Stretch stretch_of(const std::array<Point, 3>& p, const Corners2& uv) {
  const Point b = difference(p[1], p[0]), c = difference(p[2], p[0]);
  const double det = twice_area(uv), area = length(cross(b, c)) / 2;
  Point along_u, along_v;
  for (std::size_t k = 0; k < 3; ++k) {
    along_u[k] = (b[k] * (uv[2][1] - uv[0][1]) - c[k] * (uv[1][1] - uv[0][1])) / det;
    along_v[k] = (c[k] * (uv[1][0] - uv[0][0]) - b[k] * (uv[2][0] - uv[0][0])) / det;
  }
  const double uu = dot(along_u, along_u), vv = dot(along_v, along_v), twice_mixed = 2 * dot(along_u, along_v);
  return {std::sqrt((uu + vv + std::hypot(uu - vv, twice_mixed)) / 2), area};
}

}  // namespace

double texel_length(const TriangleMesh& mesh, const Attribute& uv, int size, double share) {
  const std::vector<Corners2> faces = uv_of_faces(mesh.triangles, uv);
  std::vector<Stretch> stretches;
  double area = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (twice_area(faces[f]) == 0) continue;
    const auto corner = [&](std::size_t k) { return mesh.points[at(mesh.triangles[f][k])]; };
    stretches.push_back(stretch_of({corner(0), corner(1), corner(2)}, faces[f]));
    area += stretches.back().area;
  }
  std::ranges::sort(stretches, std::greater{}, &Stretch::longest);
  double beyond = 0;
  for (const Stretch& s : stretches)
    if ((beyond += s.area) > share * area) return s.longest / size;
  return 0;
}

bool has_uv(const TriangleMesh& shape) {
  const Attribute* uv = shape.find("uv");
  return uv && uv->components == 2 && uv->domain != Domain::face;
}

}  // namespace pelage

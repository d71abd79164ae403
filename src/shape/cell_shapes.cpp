#include "shape/cell_shapes.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "shape/covered_parts.h"
#include "shape/soup_edges.h"

namespace pelage {

namespace {

/// Of border pieces [radius].
constexpr double longest_piece = 0.25;

std::vector<BorderPiece> pieces_of_open_edges(const TriangleMesh& mesh, const CoveredParts* covered, double longest) {
  std::vector<BorderPiece> pieces;
  const std::vector<std::int32_t> twin = soup_twins(mesh);
  for (std::size_t h = 0; h < twin.size(); ++h) {
    if (twin[h] != -1) continue;
    const Triangle& t = mesh.triangles[h / 3];
    const auto corner = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k % 3])]; };
    const Point a = corner(h % 3), along = difference(corner(h % 3 + 1), a);
    const Point normal = unit(cross(along, difference(corner(h % 3 + 2), a)));
    if (!(length(normal) > 0)) continue;
    const double count = std::ceil(length(along) / longest);
    for (double k = 0.5; k < count; ++k) {
      BorderPiece piece{a, normal, unit(cross(along, normal)), length(along) / count / 2};
      for (std::size_t d = 0; d < 3; ++d) piece.middle[d] += k / count * along[d];
      if (!covered || !covered->covers(static_cast<std::int32_t>(h / 3), piece.middle)) pieces.push_back(piece);
    }
  }
  return pieces;
}

/// Whether there is a cell straight on beyond the border: even cells leave no room of this size free.
bool goes_on(const BorderPiece& piece, const CellNeighbours& neighbours, double radius,
             std::vector<CellNeighbour>& found) {
  neighbours.find(piece.middle, piece.normal, radius, -1, found);
  return std::ranges::any_of(found, [&](const CellNeighbour& n) {
    const double on = dot(n.way, piece.outward);
    return on > 0.1 * radius && n.square - on * on < 0.25 * radius * radius;
  });
}

}  // namespace

std::vector<BorderPiece> border_pieces(const Cells& cells, const CellNeighbours& neighbours) {
  std::vector<BorderPiece> pieces = pieces_of_open_edges(*cells.on, cells.covered.get(), longest_piece * cells.radius);
  std::vector<char> continued(pieces.size(), 0);
  parallel_for(pieces.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<CellNeighbour> found;
    for (std::size_t k = begin; k < end; ++k) continued[k] = goes_on(pieces[k], neighbours, cells.radius, found);
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (!continued[k]) pieces[kept++] = pieces[k];
  pieces.resize(kept);
  return pieces;
}

CellShapes::CellShapes(const Cells& cells, double stretch)
    : cells_(cells),
      within_(2 * cells.radius * std::sqrt(stretch)),
      // Where no border is known, cells end where those of even points do.
      reach_(cells.radius * (cells.on->triangles.empty() ? 0.5 : 1.0)),
      neighbours_(cells.points, cells.normals, cells.radius),
      border_(border_pieces(cells, neighbours_)) {
  std::vector<Point> middles;
  for (const BorderPiece& p : border_) middles.push_back(p.middle);
  if (!middles.empty()) border_index_ = std::make_unique<const PointIndex>(middles, cells.radius);
}

namespace {

PlanePoint times(const PlaneMatrix& m, const PlanePoint& p) {
  return {m[0] * p[0] + m[1] * p[1], m[1] * p[0] + m[2] * p[1]};
}

PlaneMatrix inverse(const PlaneMatrix& m) {
  const double determinant = m[0] * m[2] - m[1] * m[1];
  return {m[2] / determinant, -m[1] / determinant, m[0] / determinant};
}

/// Whether the segment from a to b has more than a point inside.
bool crosses(const PlaneCell& cell, const PlanePoint& a, const PlanePoint& b) {
  double begin = 0, end = 1;
  const PlanePoint step = {b[0] - a[0], b[1] - a[1]};
  for (std::size_t k = 0; k < cell.corner.size() && begin < end; ++k) {
    const PlanePoint &p = cell.corner[k], &q = cell.corner[(k + 1) % cell.corner.size()];
    const PlanePoint out = {q[1] - p[1], p[0] - q[0]};
    const double height = out[0] * (a[0] - p[0]) + out[1] * (a[1] - p[1]), rise = out[0] * step[0] + out[1] * step[1];
    if (rise > 0)
      end = std::min(end, -height / rise);
    else if (rise < 0)
      begin = std::max(begin, -height / rise);
    else if (height > 0)
      return false;
  }
  return begin < end;
}

}  // namespace

PlaneCell CellShapes::made(std::size_t cell, Scratch& scratch, const PlaneMatrix* contraction) const {
  const TangentFrame frame(cells_.normals[cell]);
  neighbours_.find(cell, within_, scratch.found);
  scratch.plane.clear();
  for (const CellNeighbour& n : scratch.found) {
    PlaneNeighbour p{n.cell, frame.in(n.way), n.square};
    if (contraction) {
      p.at = times(*contraction, p.at);
      p.square = p.at[0] * p.at[0] + p.at[1] * p.at[1];
    }
    scratch.plane.push_back(p);
  }
  PlaneCell shape = voronoi_cell(scratch.plane, reach_);
  if (border_index_) cut_at_border(cell, frame, contraction, shape);
  return shape;
}

void CellShapes::cut_at_border(std::size_t cell, const TangentFrame& frame, const PlaneMatrix* contraction,
                               PlaneCell& shape) const {
  const Point& from = cells_.points[cell];
  const Point& normal = cells_.normals[cell];
  const PlaneCell whole = shape;
  border_index_->for_each_within(from, within_, [&](std::int32_t number, double) {
    const BorderPiece& piece = border_[static_cast<std::size_t>(number)];
    const Point v = difference(piece.middle, from);
    if (!(dot(normal, piece.normal) > opposing_normals)) return;
    const Unfolded u = unfolded(v, normal, piece.normal);
    if (!on_one_sheet(v, u.square, normal, piece.normal)) return;
    const PlanePoint middle = frame.in(u.way), out = frame.in(turned_into(piece.outward, piece.normal, normal));
    const double limit = middle[0] * out[0] + middle[1] * out[1];
    if (limit < -1e-6 * cells_.radius) return;  // seen from behind
    const auto end = [&](double side) {
      const PlanePoint p = {middle[0] - side * piece.half * out[1], middle[1] + side * piece.half * out[0]};
      return contraction ? times(*contraction, p) : p;
    };
    if (!crosses(whole, end(-1), end(1))) return;
    shape.clip(contraction ? times(inverse(*contraction), out) : out, std::max(limit, 0.0), {});
  });
}

}  // namespace pelage

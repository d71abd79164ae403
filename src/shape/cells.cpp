#include "shape/cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "pelage/error.h"
#include "shape/cell_relaxation.h"
#include "shape/cloud_points.h"
#include "shape/mesh_place.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::unique_ptr<const CellGround> ground_of(std::shared_ptr<const TriangleMesh> on) {
  return on->triangles.empty() ? cloud_ground(std::move(on)) : polygon_ground(std::move(on));
}

/// Seven cells to a wave: from here on less than a point of the cloud comes to a wave, and what is between them is
/// guesswork, with cells that are crowded at the ends of what the points know, which makes steps tiny.
constexpr double most_cells_per_point = 64;

void require_number(std::size_t n) {
  if (n < fewest_cells || n > most_cells)
    throw Error(Fault::usage, "a shape can have " + std::to_string(fewest_cells) + " to " + std::to_string(most_cells) +
                                  " cells, not " + std::to_string(n));
}

/// At the corners of a triangle, or the one value of a face or of a point of a cloud.
std::array<std::size_t, 3> tuples_of(const Attribute& a, const TriangleMesh& on, std::int32_t face) {
  if (a.domain == Domain::corner) return {3 * at(face), 3 * at(face) + 1, 3 * at(face) + 2};
  if (a.domain == Domain::face || on.triangles.empty()) return {at(face), at(face), at(face)};
  const Triangle& t = on.triangles[at(face)];
  return {at(t[0]), at(t[1]), at(t[2])};
}

Attribute at_cells(const Attribute& given, const Cells& cells) {
  Attribute a{given.name, given.components, Domain::vertex, {}, given.type, given.labels};
  const auto components = at(given.components);
  const bool between = given.domain != Domain::face && !cells.place.empty();
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    const auto tuple = tuples_of(given, *cells.on, cells.face[i]);
    const auto [v, w] = between ? cells.place[i] : std::array<double, 2>{};
    for (std::size_t k = 0; k < components; ++k) {
      const auto value = [&](std::size_t corner) { return given.values[components * tuple[corner] + k]; };
      a.values.push_back(between ? (1 - v - w) * value(0) + v * value(1) + w * value(2) : value(0));
    }
  }
  if (between) widen(a);
  return a;
}

}  // namespace

CellMaker::CellMaker(std::shared_ptr<const TriangleMesh> on) : on_(std::move(on)), ground_(ground_of(on_)) {}
CellMaker::~CellMaker() = default;
Box CellMaker::box() const { return ground_->box(); }
std::size_t CellMaker::outliers() const { return ground_->outliers(); }
double CellMaker::covered_share() const { return ground_->covered() ? ground_->covered()->share() : 0; }

Cells CellMaker::make(std::size_t n) const {
  require_number(n);
  Cells cells;
  cells.on = on_;
  cells.covered = ground_->covered();
  cells.radius = 2 * std::sqrt(ground_->area() / static_cast<double>(n));
  for (const CellPlace& p : relaxed_places(*ground_, n, cells.radius)) {
    cells.points.push_back(p.point);
    cells.normals.push_back(p.normal);
    cells.face.push_back(p.face);
    if (!on_->triangles.empty()) cells.place.push_back(p.place);
  }
  return cells;
}

std::size_t CellMaker::for_edge(double edge) const {
  const double n = 2 / std::numbers::sqrt3 * ground_->area() / (edge * edge);  // sqrt(3)/2 edge^2 to a vertex
  if (!(n <= static_cast<double>(most_cells)))
    throw Error(Fault::usage, "the pattern is too fine for cells on this shape: it needs more than " +
                                  std::to_string(most_cells) + "; ask for a larger --size, or give --cells");
  const std::size_t points = ground_->points_that_count();
  if (points > 0 && n > most_cells_per_point * static_cast<double>(points))
    throw Error(Fault::usage, "the pattern is too fine for " + std::to_string(points) +
                                  " points, which are further apart than its waves; ask for a larger --size, or give "
                                  "more points, or --cells");
  return std::max(fewest_cells, static_cast<std::size_t>(std::ceil(n)));
}

Cells make_cells(std::shared_ptr<const TriangleMesh> on, std::size_t n) { return CellMaker(std::move(on)).make(n); }

std::size_t cells_for_edge(const TriangleMesh& on, double edge) {
  const auto not_owned = [](const TriangleMesh*) {};  // it outlives this call
  return CellMaker(std::shared_ptr<const TriangleMesh>(&on, not_owned)).for_edge(edge);
}

Cells cells_at_points(std::shared_ptr<const TriangleMesh> cloud) {
  constexpr double further = 1.5;
  CloudPoints points = cloud_points(*cloud);
  Cells cells;
  cells.on = std::move(cloud);
  const double area = std::accumulate(points.area.begin(), points.area.end(), 0.0);
  cells.radius = further * 2 * std::sqrt(area / static_cast<double>(points.point.size()));
  cells.points = std::move(points.point);
  cells.normals = std::move(points.normal);
  cells.face = std::move(points.number);
  return cells;
}

TriangleMesh mesh_of(const Cells& cells) {
  TriangleMesh mesh;
  mesh.points = cells.points;
  for (const Attribute& a : cells.on->attributes)
    if (a.name != "normal") mesh.attributes.push_back(at_cells(a, cells));
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& n : cells.normals) normal.values.insert(normal.values.end(), n.begin(), n.end());
  mesh.set(std::move(normal));
  mesh.metres_per_unit = cells.on->metres_per_unit;
  return mesh;
}

}  // namespace pelage

#include "run/cell_lines.h"

#include <cmath>
#include <limits>

#include "base/box.h"
#include "discretise/cell_space.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point tangential(const Point& v, const Point& normal) {
  const double along = dot(v, normal);
  return unit({v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]});
}

TangentPlanes planes_of(const CellSpace& space) {
  TangentPlanes planes;
  planes.area = space.area();
  planes.normal = space.cells().normals;
  for (const Point& n : planes.normal) {
    const TangentFrame frame(n);
    planes.east.push_back(frame.e);
    planes.north.push_back(frame.f);
  }
  return planes;
}

/// Over their sides.
std::vector<PlaneLink> links_of(const CellSpace& space, const TangentPlanes& planes) {
  const SparseMatrix& k = *space.stiffness();
  std::vector<PlaneLink> links;
  for (Index i = 0; i < k.rows(); ++i)
    for (auto e = at(k.pattern->start[at(i)]); e < at(k.pattern->start[at(i) + 1]); ++e) {
      const Index j = k.pattern->column[e];
      if (j <= i || !(k.value[e] < 0)) continue;
      const Point there = turned_into(planes.east[at(i)], planes.normal[at(i)], planes.normal[at(j)]);
      links.push_back({i, j, -k.value[e], planes.angle(j, there)});
    }
  return links;
}

/// What a field on cells is made of.
struct CellField {
  explicit CellField(Cells cells)
      : space((cells.stretch = 1, std::move(cells))), planes(planes_of(space)), links(links_of(space, planes)) {}

  std::vector<Point> lines(const std::vector<Guide>& guides) const {
    return direction_field(planes, links, 2, guides).direction;
  }
  std::vector<Guide> guides(const FieldWish& wish) const {
    const Cells& cells = space.cells();
    const GuidedSurface surface{.planes = planes,
                                .points = cells.points,
                                .edge = cells.radius / 2,
                                .curvature = [&] { return space.curvature(); },
                                .way =
                                    [&](const std::vector<Index>& low, const std::vector<Index>& high) {
                                      const std::vector<double> f =
                                          harmonic_function(planes.places(), links, low, high);
                                      return space.gradients(Vector::Map(f.data(), std::ssize(f)));
                                    }};
    return find_guides(wish, surface, box_of(cells.points).diagonal());
  }

  CellSpace space;
  TangentPlanes planes;
  std::vector<PlaneLink> links;
};

}  // namespace

std::vector<Point> wished_lines(const Cells& cells, const FieldWish& wish) {
  const CellField field(cells);
  return field.lines(field.guides(wish));
}

std::vector<Point> completed_lines(const Cells& cells, const std::vector<Point>& given) {
  std::vector<Point> lines(cells.nodes(), Point{});
  std::vector<Guide> guides;
  for (std::size_t i = 0; i < given.size(); ++i) {
    lines[i] = tangential(given[i], cells.normals[i]);
    if (length(lines[i]) > 0)
      guides.push_back({static_cast<Index>(i), lines[i], std::numeric_limits<double>::infinity()});
  }
  if (guides.size() == lines.size()) return lines;
  const std::vector<Point> found = CellField(cells).lines(guides);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!(length(lines[i]) > 0)) lines[i] = found[i];
  return lines;
}

}  // namespace pelage

#include "shape/hierarchy.h"

#include <string>

#include "pelage/error.h"
#include "shape/creases.h"
#include "shape/refine.h"

namespace pelage {

Hierarchy::Hierarchy(Topology base, Rule rule)
    : rule_(rule), levels_{{std::make_shared<const Topology>(std::move(base)), nullptr}} {}

void Hierarchy::refine() {
  Refinement fine = rule_(topology(finest()));
  Topology split = make_topology(fine.stencils.rows(), std::move(fine.triangles));
  split.creases = split_creases(topology(finest()), split);
  levels_.push_back(
      {std::make_shared<const Topology>(std::move(split)), std::make_shared<const Stencils>(std::move(fine.stencils))});
}

std::vector<double> Hierarchy::interpolated(std::vector<double> values, std::size_t components, int from,
                                            int to) const {
  for (int level = from; level < to; ++level) values = split_values(topology(level), values, components);
  return values;
}

std::vector<Point> Hierarchy::interpolated(std::vector<Point> points, int from, int to) const {
  for (int level = from; level < to; ++level) points = split_points(topology(level), points);
  return points;
}

void Hierarchy::interpolate(Attribute& attribute, int from, int to) const {
  for (int level = from; level < to; ++level) split_attribute(topology(level), attribute);
}

void refine_to_edge(Hierarchy& hierarchy, std::vector<Point>& points, double edge, std::size_t max_triangles) {
  while (prevailing_edge(hierarchy.topology(hierarchy.finest()).triangles, points) > edge) {
    if (4 * hierarchy.topology(hierarchy.finest()).triangles.size() > max_triangles)
      throw Error(Fault::input, "the pattern is too fine for this shape: it needs more than " +
                                    std::to_string(max_triangles) + " triangles; ask for a larger --size");
    hierarchy.refine();
    points = hierarchy.refined(std::move(points), hierarchy.finest() - 1, hierarchy.finest());
  }
}

}  // namespace pelage

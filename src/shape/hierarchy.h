#pragma once
// The levels of a mesh whose triangles are split into four again and again. Connectivity and the weights of the rule
// are made once; positions, fields and attributes pass through them as often as they change.

#include <memory>
#include <vector>

#include "shape/loop_subdivision.h"

namespace pelage {

/// Cheap to copy: copies share the levels that they have in common.
class Hierarchy {
 public:
  /// How the values of one level follow from those of the level before.
  using Rule = Refinement (*)(const Topology&);

  /// The mesh alone, as level 0.
  Hierarchy(Topology base, Rule rule);

  /// The finest level that there is.
  int finest() const { return static_cast<int>(levels_.size()) - 1; }
  const Topology& topology(int level) const { return *shared_topology(level); }
  const std::shared_ptr<const Topology>& shared_topology(int level) const {
    return levels_[static_cast<std::size_t>(level)].topology;
  }
  /// One more level.
  void refine();

  /// Values at the vertices of level `to`, by the rule, from those of level `from` <= to (tuple after tuple).
  template <class Values>
  Values refined(Values values, int from, int to) const {
    for (int level = from; level < to; ++level)
      values = combine(*levels_[static_cast<std::size_t>(level) + 1].rule, values);
    return values;
  }
  /// The same, but linear over the triangles.
  std::vector<double> interpolated(std::vector<double> values, std::size_t components, int from, int to) const;
  std::vector<Point> interpolated(std::vector<Point> points, int from, int to) const;
  void interpolate(Attribute& attribute, int from, int to) const;

 private:
  struct Level {
    std::shared_ptr<const Topology> topology;
    std::shared_ptr<const Stencils> rule;  ///< from the level before; null for level 0
  };
  Rule rule_;
  std::vector<Level> levels_;
};

/// Adds levels until the prevailing edge of `points`, which are at the vertices of the finest level, is at most `edge`,
/// and refines the points with them. Error(Fault::input) when that needs more than `max_triangles`.
void refine_to_edge(Hierarchy& hierarchy, std::vector<Point>& points, double edge, std::size_t max_triangles);

}  // namespace pelage

#pragma once
// The creases of a mesh as lines between corners, to move along.

#include "shape/topology.h"

namespace pelage {

/// Every line runs in one direction, from one corner or end of a crease to the next or once around.
class CreaseLines {
 public:
  /// On a half-edge in the direction of its line, as a fraction of it.
  struct Place {
    Index halfedge;
    double along;
  };

  CreaseLines(const Topology& topology, const std::vector<Point>& points);

  bool empty() const { return lines_.empty(); }
  /// The number of the line on which a half-edge lies, from 1 on, negative against its direction; 0 beside creases.
  Index line(Index halfedge) const { return line_.empty() ? 0 : line_[static_cast<std::size_t>(halfedge)]; }
  /// The half-edge after one on a line, in its own direction; -1 at the end.
  Index next(Index halfedge) const;
  Place begin(Index line) const;
  Place end(Index line) const;
  /// So far along the line, backwards for negative lengths, at most to its ends.
  Place advance(const Place& from, double length) const;
  /// Half way along the line from one place on, in its direction, to another.
  Place middle(const Place& from, const Place& to) const;

 private:
  struct Line {
    std::vector<Index> halfedges;
    std::vector<double> start;  ///< of each from the beginning of the line, and the length of all
    bool closed = false;
  };
  const Line& line_of(Index halfedge) const {
    return lines_[static_cast<std::size_t>(line_[static_cast<std::size_t>(halfedge)] - 1)];
  }
  void add_line(Index halfedge, const std::vector<Point>& points);
  double arc(const Place& place) const;
  static Place at(const Line& line, double arc);

  const Topology& topology_;
  std::vector<char> ends_;              ///< per vertex: whether lines end there
  std::vector<Index> line_, position_;  ///< per half-edge
  std::vector<Line> lines_;
};

/// Numbers per triangle that are the same where no crease is between them.
std::vector<Index> smooth_regions(const Topology& topology);

}  // namespace pelage

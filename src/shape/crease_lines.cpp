#include "shape/crease_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/creases.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

CreaseLines::CreaseLines(const Topology& t, const std::vector<Point>& points) : topology_(t) {
  if (!t.creases.any()) return;
  line_.assign(t.twin.size(), 0);
  position_.assign(t.twin.size(), -1);
  ends_.resize(points.size());
  VertexRing around;
  for (Index v = 0; v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    ends_[pelage::at(v)] = around.corner || around.sharp.size() != 2;
  }
  for (std::size_t h = 0; h < t.twin.size(); ++h)
    if (t.twin[h] >= 0 && t.sharp(static_cast<Index>(h)) && line_[h] == 0) add_line(static_cast<Index>(h), points);
}

Index CreaseLines::next(Index h) const {
  if (ends_[pelage::at(topology_.target(h))]) return -1;
  const Index back = topology_.twin[pelage::at(h)];
  Index g = topology_.rotate(back);
  while (!topology_.sharp(g)) g = topology_.rotate(g);
  return g;
}

void CreaseLines::add_line(Index h, const std::vector<Point>& points) {
  const auto twin = [&](Index g) { return topology_.twin[pelage::at(g)]; };
  Line line;
  Index first = h;
  for (Index back = next(twin(first)); back >= 0; back = next(twin(first))) {
    first = twin(back);
    line.closed = first == h;
    if (line.closed) break;
  }
  line.start.push_back(0);
  const auto number = static_cast<Index>(lines_.size()) + 1;
  for (Index g = first; g >= 0; g = next(g)) {
    if (g == first && !line.halfedges.empty()) break;
    const Point &a = points[pelage::at(topology_.origin(g))], &b = points[pelage::at(topology_.target(g))];
    line_[pelage::at(g)] = number;
    line_[pelage::at(twin(g))] = -number;
    position_[pelage::at(g)] = static_cast<Index>(line.halfedges.size());
    line.halfedges.push_back(g);
    // Never 0, so that fractions are defined.
    line.start.push_back(line.start.back() + std::max(length(difference(b, a)), std::numeric_limits<double>::min()));
  }
  lines_.push_back(std::move(line));
}

CreaseLines::Place CreaseLines::begin(Index line) const { return {lines_[pelage::at(line - 1)].halfedges.front(), 0}; }
CreaseLines::Place CreaseLines::end(Index line) const { return {lines_[pelage::at(line - 1)].halfedges.back(), 1}; }

double CreaseLines::arc(const Place& place) const {
  const Line& line = line_of(place.halfedge);
  const std::size_t i = pelage::at(position_[pelage::at(place.halfedge)]);
  return line.start[i] + place.along * (line.start[i + 1] - line.start[i]);
}

CreaseLines::Place CreaseLines::at(const Line& line, double arc) {
  const double whole = line.start.back();
  if (line.closed) arc -= whole * std::floor(arc / whole);
  arc = std::clamp(arc, 0.0, whole);
  const auto after = std::upper_bound(line.start.begin() + 1, line.start.end() - 1, arc);
  const auto i = static_cast<std::size_t>(after - line.start.begin()) - 1;
  return {line.halfedges[i], std::clamp((arc - line.start[i]) / (line.start[i + 1] - line.start[i]), 0.0, 1.0)};
}

CreaseLines::Place CreaseLines::advance(const Place& from, double length) const {
  return at(line_of(from.halfedge), arc(from) + length);
}

CreaseLines::Place CreaseLines::middle(const Place& from, const Place& to) const {
  const Line& line = line_of(from.halfedge);
  double length = arc(to) - arc(from);
  if (line.closed && length <= 0) length += line.start.back();
  return at(line, arc(from) + length / 2);
}

std::vector<Index> smooth_regions(const Topology& t) {
  std::vector<Index> region(t.triangles.size(), -1), open;
  Index count = 0;
  for (std::size_t f = 0; f < region.size(); ++f) {
    if (region[f] >= 0) continue;
    region[f] = count;
    open.push_back(static_cast<Index>(f));
    while (!open.empty()) {
      const Index face = open.back();
      open.pop_back();
      for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (t.sharp(h)) continue;
        Index& beyond = region[at(t.twin[at(h)] / 3)];
        if (beyond >= 0) continue;
        beyond = count;
        open.push_back(t.twin[at(h)] / 3);
      }
    }
    ++count;
  }
  return region;
}

}  // namespace pelage

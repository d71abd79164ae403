#include "shape/stroke.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box.h"
#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// The nearest place of a polyline: which of its segments, and how far from there.
struct NearestSegment {
  std::size_t segment = 0;
  double square = std::numeric_limits<double>::infinity();
};

double square_distance(const Point& p, const Point& a, const Point& b) {
  const Point along = difference(b, a), from = difference(p, a);
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(from, along) / square, 0.0, 1.0) : 0;
  const Point off = {from[0] - t * along[0], from[1] - t * along[1], from[2] - t * along[2]};
  return dot(off, off);
}

/// A dab is a segment without length.
std::size_t segment_count(const std::vector<Point>& line) { return std::max<std::size_t>(line.size(), 2) - 1; }
const Point& end_of(const std::vector<Point>& line, std::size_t segment) {
  return line[std::min(segment + 1, line.size() - 1)];
}

NearestSegment nearest_segment(const std::vector<Point>& line, const Point& p) {
  NearestSegment nearest;
  for (std::size_t k = 0; k < segment_count(line); ++k)
    if (const double square = square_distance(p, line[k], end_of(line, k)); square < nearest.square)
      nearest = {k, square};
  return nearest;
}

/// Of each segment the normal at the position that is nearest to its middle.
std::vector<Point> normals_along(const std::vector<Point>& line, const std::vector<Point>& positions,
                                 const std::vector<Point>& normals) {
  std::vector<Point> along;
  if (normals.empty()) return along;
  for (std::size_t k = 0; k < segment_count(line); ++k) {
    const Point middle = Box{line[k], end_of(line, k)}.middle();
    const auto nearest = std::ranges::min_element(
        positions, {}, [&](const Point& p) { return dot(difference(p, middle), difference(p, middle)); });
    along.push_back(normals[static_cast<std::size_t>(nearest - positions.begin())]);
  }
  return along;
}

bool within(const Box& box, const Point& p) {
  return p[0] >= box.low[0] && p[1] >= box.low[1] && p[2] >= box.low[2] && p[0] <= box.high[0] && p[1] <= box.high[1] &&
         p[2] <= box.high[2];
}

/// 1 up to the hard part, 0 from the edge on, with continuous slope between them.
double share_at(double distance, const BrushStroke& stroke) {
  const double hard = stroke.hardness * stroke.radius;
  if (distance <= hard) return 1;
  if (distance >= stroke.radius) return 0;
  const double t = (stroke.radius - distance) / (stroke.radius - hard);
  return t * t * (3 - 2 * t);
}

}  // namespace

std::vector<double> stroke_shares(const BrushStroke& stroke, const std::vector<Point>& positions,
                                  const std::vector<Point>& normals) {
  std::vector<double> shares(positions.size(), 0.0);
  if (stroke.points.empty() || positions.empty()) return shares;
  Box reach = box_of(stroke.points);
  for (std::size_t k = 0; k < 3; ++k) {
    reach.low[k] -= stroke.radius;
    reach.high[k] += stroke.radius;
  }
  const std::vector<Point> along = normals_along(stroke.points, positions, normals);
  parallel_for(positions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!within(reach, positions[i])) continue;
      const NearestSegment nearest = nearest_segment(stroke.points, positions[i]);
      if (along.empty() || dot(normals[i], along[nearest.segment]) > 0)
        shares[i] = share_at(std::sqrt(nearest.square), stroke);
    }
  });
  return shares;
}

}  // namespace pelage

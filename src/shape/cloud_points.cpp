#include "shape/cloud_points.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "base/parallel.h"
#include "base/quantile.h"
#include "pelage/error.h"
#include "shape/cell_voronoi.h"
#include "shape/finding.h"
#include "shape/places.h"
#include "shape/point_index.h"

namespace pelage {

namespace {

constexpr std::size_t nearest = CloudPoints::nearest;
constexpr std::size_t chunk = 256;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// About two spacings of the points of a surface, whatever a few of them that are far away say.
double box_side(const std::vector<Point>& points) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> x;
    for (const Point& p : points) x.push_back(p[k]);
    const double high = quantile(x, 0.98);
    square += std::pow(high - quantile(x, 0.02), 2);
  }
  return 2 * std::sqrt(square / static_cast<double>(points.size()));
}

struct Near {
  double square;
  std::int32_t index;
  auto operator<=>(const Near&) const = default;
};

/// In order of their distance; fewer than `count` where there are no more within 16 boxes.
void find_nearest(const PointIndex& index, const Point& from, double side, std::size_t count, std::int32_t except,
                  std::vector<Near>& found) {
  for (double radius = side; radius <= 16 * side; radius *= 2) {
    found.clear();
    index.for_each_within(from, radius, [&](std::int32_t j, double square) {
      if (j != except) found.push_back({square, j});
    });
    if (found.size() >= count) break;
  }
  const std::size_t kept = std::min(count, found.size());
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
  found.resize(kept);
}

/// Distance to the sixth nearest point, in the median over some of them.
double usual_spacing(const std::vector<Point>& points, const PointIndex& index, double side) {
  constexpr std::size_t asked = 2000;
  std::vector<double> distance;
  std::vector<Near> found;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / asked) {
    find_nearest(index, points[i], side, 6, static_cast<std::int32_t>(i), found);
    if (!found.empty()) distance.push_back(std::sqrt(found.back().square));
  }
  return distance.empty() ? 0 : quantile(distance, 0.5);
}

/// Numbers of the points without those too near to an earlier one, which add nothing but noise.
std::vector<std::int32_t> thinned(const std::vector<Point>& points, double side) {
  constexpr double least = 0.25;  // of the distance to the sixth
  const PointIndex index(points, side);
  const double radius = least * usual_spacing(points, index, side);
  std::vector<char> gone(points.size(), 0);
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (gone[i]) continue;
    kept.push_back(static_cast<std::int32_t>(i));
    if (radius > 0) index.for_each_within(points[i], radius, [&](std::int32_t j, double) { gone[at(j)] = 1; });
  }
  return kept;
}

std::vector<Point> taken(const std::vector<Point>& points, const std::vector<std::int32_t>& which) {
  std::vector<Point> result;
  for (const std::int32_t i : which) result.push_back(points[at(i)]);
  return result;
}

/// Per point the nearest others, or -1 where there are no more; and the distance to the last of them.
void find_neighbours(const std::vector<Point>& points, double side, std::vector<std::int32_t>& near,
                     std::vector<double>& reach) {
  const PointIndex index(points, side);
  near.assign(nearest * points.size(), -1);
  reach.assign(points.size(), std::numeric_limits<double>::infinity());
  parallel_for(
      points.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Near> found;
        for (std::size_t i = begin; i < end; ++i) {
          find_nearest(index, points[i], side, nearest, static_cast<std::int32_t>(i), found);
          for (std::size_t k = 0; k < found.size(); ++k) near[nearest * i + k] = found[k].index;
          if (found.size() == nearest) reach[i] = std::sqrt(found.back().square);
        }
      },
      chunk);
}

/// Those whose neighbours are much nearer to each other than to them, and those that are far from all others.
std::vector<char> find_outliers(const std::vector<std::int32_t>& near, const std::vector<double>& reach) {
  constexpr double furthest = 4, furthest_of_all = 8;
  std::vector<char> out(reach.size(), 0);
  std::vector<double> all = reach;
  const double usual = quantile(all, 0.5);
  for (std::size_t i = 0; i < reach.size(); ++i) {
    std::vector<double> others;
    for (std::size_t k = 0; k < nearest && near[nearest * i + k] >= 0; ++k)
      others.push_back(reach[at(near[nearest * i + k])]);
    out[i] = others.size() < nearest ||
             !(reach[i] <= furthest * quantile(others, 0.5) && reach[i] <= furthest_of_all * usual);
  }
  return out;
}

/// Finite points without copies.
std::vector<std::int32_t> different_points(const std::vector<Point>& points) {
  const std::vector<std::int32_t> place = same_places(points, std::vector<char>(points.size(), 1));
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (at(place[i]) == i && std::ranges::all_of(points[i], [](double x) { return std::isfinite(x); }))
      result.push_back(static_cast<std::int32_t>(i));
  return result;
}

void require_enough(std::size_t count) {
  if (count < 2 * nearest)
    throw Error(Fault::input, "a cloud of " + counted(count, "point") + " is no surface: it needs at least " +
                                  std::to_string(2 * nearest) + " in different places");
}

void choose_points(const TriangleMesh& mesh, CloudPoints& cloud) {
  std::vector<std::int32_t> numbers = different_points(mesh.points);
  require_enough(numbers.size());
  std::vector<Point> points = taken(mesh.points, numbers);
  double side = box_side(points);
  if (!(side > 0)) throw Error(Fault::input, "the points lie in no surface: they are nearly all in one place");
  const std::vector<std::int32_t> some = thinned(points, side);
  for (const std::int32_t i : some) cloud.number.push_back(numbers[at(i)]);
  points = taken(points, some);
  find_neighbours(points, side, cloud.near, cloud.reach);
  const std::vector<char> out = find_outliers(cloud.near, cloud.reach);
  cloud.outliers = at(std::ranges::count(out, 1));
  if (cloud.outliers > 0) {
    std::vector<std::int32_t> inner;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (!out[i]) inner.push_back(cloud.number[i]);
    cloud.number = std::move(inner);
    require_enough(cloud.number.size());
    points = taken(mesh.points, cloud.number);
    find_neighbours(points, side, cloud.near, cloud.reach);
  }
  require_enough(points.size());
  cloud.point = std::move(points);
  cloud.kept.assign(mesh.points.size(), -1);
  for (std::size_t i = 0; i < cloud.number.size(); ++i) cloud.kept[at(cloud.number[i])] = static_cast<std::int32_t>(i);
  // A point whose neighbours left with the outliers is its own neighbour instead.
  for (std::size_t i = 0; i < cloud.near.size(); ++i)
    if (cloud.near[i] < 0) cloud.near[i] = static_cast<std::int32_t>(i / nearest);
  for (double& reach : cloud.reach)
    if (!std::isfinite(reach)) reach = side;
}

/// A plane through a point's neighbours.
struct PlaneFit {
  Point normal;    ///< of either sign
  bool on_a_line;  ///< so that any plane through the line does as well
};

PlaneFit plane_of(const CloudPoints& cloud, std::size_t i) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::int32_t j : cloud.neighbours(i)) {
    const Point v = difference(cloud.point[at(j)], cloud.point[i]);
    const Eigen::Vector3d x(v[0], v[1], v[2]);
    mean += x;
    moments += x * x.transpose();
  }
  constexpr double count = nearest + 1;
  moments -= mean * mean.transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments);
  const Eigen::Vector3d n = axes.eigenvectors().col(0);
  constexpr double least_width = 0.1;  // of their length
  return {{n[0], n[1], n[2]}, axes.eigenvalues()[1] <= least_width * least_width * axes.eigenvalues()[2]};
}

/// Where nothing is given; `known` says where. Error(Fault::input) where most points are on lines.
void fit_normals(const std::vector<char>& known, CloudPoints& cloud) {
  std::vector<char> lined(known.size(), 0);
  parallel_for(
      known.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (known[i]) continue;
          const PlaneFit fit = plane_of(cloud, i);
          cloud.normal[i] = fit.normal;
          lined[i] = fit.on_a_line;
        }
      },
      chunk);
  if (2 * at(std::ranges::count(lined, 1)) > lined.size())
    throw Error(
        Fault::input,
        "the points lie along lines, in no surface; where they are lines of a scan, give points as dense across "
        "them as along, or normals");
}

/// Whose sign is known: those that the file gives.
std::vector<char> take_given(const TriangleMesh& mesh, CloudPoints& cloud) {
  std::vector<char> known(cloud.point.size(), 0);
  const Attribute* given = mesh.find("normal");
  if (!given || given->components != 3 || given->domain != Domain::vertex) return known;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double* n = given->values.data() + 3 * at(cloud.number[i]);
    const Point normal = unit({n[0], n[1], n[2]});
    known[i] = std::abs(length(normal) - 1) < 1e-9;
    if (known[i]) cloud.normal[i] = normal;
  }
  return known;
}

/// Turns normals alike from point to point, always over the pair that differs least (Hoppe and others 1992).
class Orientation {
 public:
  Orientation(CloudPoints& cloud, std::vector<char> known) : cloud_(cloud), known_(std::move(known)) {
    for (std::size_t i = 0; i < known_.size(); ++i)
      for (const std::int32_t j : cloud.neighbours(i)) ++start_[at(j) + 1];
    for (std::size_t i = 0; i < known_.size(); ++i) start_[i + 1] += start_[i];
    back_.resize(at(start_.back()));
    std::vector<std::int64_t> next = start_;
    for (std::size_t i = 0; i < known_.size(); ++i)
      for (const std::int32_t j : cloud.neighbours(i)) back_[at(next[at(j)]++)] = static_cast<std::int32_t>(i);
  }

  void run() {
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (known_[i]) offer(i);
    spread();
    std::vector<std::int32_t> order(known_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
    std::ranges::sort(order, [&](std::int32_t a, std::int32_t b) {
      const double za = cloud_.point[at(a)][2], zb = cloud_.point[at(b)][2];
      return za != zb ? za > zb : a < b;
    });
    for (const std::int32_t i : order) {
      if (known_[at(i)]) continue;
      if (cloud_.normal[at(i)][2] < 0) turn(at(i));
      known_[at(i)] = 1;
      offer(at(i));
      spread();
    }
  }

 private:
  struct Pair {
    double difference;
    std::int32_t to, from;
    auto operator<=>(const Pair&) const = default;
  };

  void turn(std::size_t i) {
    for (double& x : cloud_.normal[i]) x = -x;
  }
  void offer(std::size_t i, std::int32_t j) {
    if (!known_[at(j)])
      open_.push({1 - std::abs(dot(cloud_.normal[i], cloud_.normal[at(j)])), j, static_cast<std::int32_t>(i)});
  }
  void offer(std::size_t i) {
    for (const std::int32_t j : cloud_.neighbours(i)) offer(i, j);
    for (auto k = start_[i]; k < start_[i + 1]; ++k) offer(i, back_[at(k)]);
  }
  void spread() {
    while (!open_.empty()) {
      const Pair pair = open_.top();
      open_.pop();
      if (known_[at(pair.to)]) continue;
      if (dot(cloud_.normal[at(pair.to)], cloud_.normal[at(pair.from)]) < 0) turn(at(pair.to));
      known_[at(pair.to)] = 1;
      offer(at(pair.to));
    }
  }

  CloudPoints& cloud_;
  std::vector<char> known_;
  std::vector<std::int64_t> start_ = std::vector<std::int64_t>(known_.size() + 1, 0);
  std::vector<std::int32_t> back_;  ///< who has a point among its nearest
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> open_;
};

/// Of the Voronoi cell among the neighbours; at borders half the usual distance wide.
double area_of(const CloudPoints& cloud, std::size_t i, std::vector<PlaneNeighbour>& plane) {
  const TangentFrame frame(cloud.normal[i]);
  plane.clear();
  for (const std::int32_t j : cloud.neighbours(i)) {
    const Point v = difference(cloud.point[at(j)], cloud.point[i]);
    const Point& m = cloud.normal[at(j)];
    if (!(dot(cloud.normal[i], m) > opposing_normals)) continue;
    const Unfolded u = unfolded(v, cloud.normal[i], m);
    if (on_one_sheet(v, u.square, cloud.normal[i], m)) plane.push_back({j, frame.in(u.way), u.square});
  }
  // So many points fill a disc of the radius `reach`; half a spacing is this share of it.
  constexpr double share = 0.45;
  return voronoi_cell(plane, share * cloud.reach[i]).area();
}

}  // namespace

CloudPoints cloud_points(const TriangleMesh& mesh) {
  CloudPoints cloud;
  choose_points(mesh, cloud);
  const std::size_t n = cloud.point.size();
  cloud.normal.resize(n);
  const std::vector<char> known = take_given(mesh, cloud);
  fit_normals(known, cloud);
  Orientation(cloud, known).run();
  cloud.area.resize(n);
  parallel_for(
      n,
      [&](std::size_t begin, std::size_t end) {
        std::vector<PlaneNeighbour> plane;
        for (std::size_t i = begin; i < end; ++i) cloud.area[i] = area_of(cloud, i, plane);
      },
      chunk);
  return cloud;
}

std::vector<double> distances_to_sixth(const std::vector<Point>& points) {
  constexpr double most = 1.5;  // of the usual distance: outliers are none the larger
  std::vector<double> distance(points.size());
  if (points.empty()) return distance;
  const double side = box_side(points);
  if (!(side > 0)) return distance;
  const PointIndex index(points, side);
  const double usual = usual_spacing(points, index, side);
  parallel_for(
      points.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Near> found;
        for (std::size_t i = begin; i < end; ++i) {
          find_nearest(index, points[i], side, 6, static_cast<std::int32_t>(i), found);
          distance[i] = found.size() < 6 ? usual : std::min(std::sqrt(found.back().square), most * usual);
        }
      },
      chunk);
  return distance;
}

}  // namespace pelage

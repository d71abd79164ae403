#include "gridgen/border.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/box.h"
#include "base/number.h"
#include "gridgen/outline.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Sides are as far apart as this share of the region's size where they do not meet.
constexpr double gap_share = 1e-6;

enum : std::size_t { south, east, north, west };

Point start_of(const Curve& c) { return c.at(std::array{0.0})[0]; }
Point end_of(const Curve& c) { return c.at(std::array{1.0})[0]; }
double distance(const Point& a, const Point& b) { return length(difference(a, b)); }

std::string side_name(std::size_t k) { return std::string("the side ") + side_names[k]; }

double size_of(const std::vector<const Curve*>& curves) {
  Box box;
  for (const Curve* c : curves)
    for (const Point& p : sample(*c, 100).points) box.add(p);
  return box.diagonal();
}

bool is_flat(const Curve& curve) {
  return std::ranges::all_of(sample(curve, 100).points, [](const Point& p) { return p[2] == 0; });
}

void require_finite(const Curve& curve, const std::string& name) {
  for (const Point& p : sample(curve).points)
    if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); }))
      throw Error(Fault::usage, name + " has a point that is not finite", curve.where);
}

void require_length(const Curve& curve, const std::string& name, double size) {
  if (!(sample(curve).total() > gap_share * size))
    throw Error(Fault::usage, name + " has no length; give it points that differ", curve.where);
}

/// Of borders that are not four sides.
void require_flat(const Curve& curve, const std::string& name) {
  if (!is_flat(curve))
    throw Error(Fault::usage, name + " lies in the plane; leave out z, and give a surface of u and v", curve.where);
}

// --- four sides --------------------------------------------------------------------------------------------

/// How far the sides are from meeting in the corners: south-east, north-east, north-west, south-west.
std::array<double, 4> gaps(const std::array<std::array<Point, 2>, 4>& ends) {
  return {distance(ends[south][1], ends[east][0]), distance(ends[east][1], ends[north][1]),
          distance(ends[north][0], ends[west][1]), distance(ends[west][0], ends[south][0])};
}

/// Turns some of the sides, as few as possible, so that the gaps are least.
void turn_to_meet(Sides& sides) {
  std::array<std::array<Point, 2>, 4> ends;
  for (std::size_t k = 0; k < 4; ++k) ends[k] = {start_of(sides[k]), end_of(sides[k])};
  unsigned best = 0;
  double least = -1;
  for (unsigned turned = 0; turned < 16; ++turned) {
    auto now = ends;
    for (std::size_t k = 0; k < 4; ++k)
      if (turned >> k & 1u) std::swap(now[k][0], now[k][1]);
    double sum = 0;
    for (const double gap : gaps(now)) sum += gap;
    if (least < 0 || sum < least) {
      least = sum;
      best = turned;
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    if (best >> k & 1u) sides[k] = reversed(sides[k]);
}

void require_meeting(const Sides& sides, double size) {
  std::array<std::array<Point, 2>, 4> ends;
  for (std::size_t k = 0; k < 4; ++k) ends[k] = {start_of(sides[k]), end_of(sides[k])};
  const auto gap = gaps(ends);
  for (std::size_t k = 0; k < 4; ++k) {
    if (gap[k] <= gap_share * size) continue;
    const std::size_t next = (k + 1) % 4;
    const Point &a = ends[k][k == south || k == east ? 1 : 0], &b = ends[next][next == north || next == west ? 1 : 0];
    throw Error(Fault::usage,
                side_name(next) + " does not meet " + side_name(k) + ": " + place_text(b) + " is not " + place_text(a) +
                    "; let both end in one corner",
                sides[next].where);
  }
}

/// The border as a closed polygon, anticlockwise where the sides are; `side_of` says whose edge each is.
std::vector<Point> loop_of(const std::array<std::vector<Point>, 4>& side, std::vector<std::size_t>* side_of = nullptr) {
  std::vector<Point> loop;
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<Point> points = side[k];
    if (k == north || k == west) std::ranges::reverse(points);
    loop.insert(loop.end(), points.begin(), points.end() - 1);
    if (side_of) side_of->resize(loop.size(), k);
  }
  return loop;
}

std::array<std::vector<Point>, 4> sampled(const Sides& sides) {
  std::array<std::vector<Point>, 4> result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = sample(sides[k], 250).points;
  return result;
}

void require_simple(const Sides& sides) {
  std::vector<std::size_t> side_of;
  const auto crossing = first_crossing(loop_of(sampled(sides), &side_of));
  if (!crossing) return;
  const std::size_t a = side_of[crossing->first], b = side_of[crossing->second];
  throw Error(Fault::usage,
              side_name(b) + " cuts " + (a == b ? "itself" : side_name(a)) + " at " + place_text(crossing->place) +
                  "; a border may not cross itself",
              sides[b].where);
}

Finding turned_finding(const std::string& what) { return {"clockwise-border", what, 1, 0, true}; }

/// West and east change places, and south and north their direction.
void turn_if_clockwise(Sides& sides, std::vector<Finding>& findings) {
  if (doubled_area(loop_of(sampled(sides))) > 0) return;
  std::swap(sides[east], sides[west]);
  sides[south] = reversed(sides[south]);
  sides[north] = reversed(sides[north]);
  findings.push_back(turned_finding("the sides went round clockwise; east and west have changed places"));
}

/// Turned so that they meet.
Sides met(Sides sides) {
  const double size = size_of({&sides[0], &sides[1], &sides[2], &sides[3]});
  for (std::size_t k = 0; k < 4; ++k) {
    require_finite(sides[k], side_name(k));
    require_length(sides[k], side_name(k), size);
  }
  turn_to_meet(sides);
  require_meeting(sides, size);
  return sides;
}

Sides four_sides(const Region& region, std::vector<Finding>& findings) {
  Sides sides = met({*region.sides[0], *region.sides[1], *region.sides[2], *region.sides[3]});
  if (!is_flat(sides, false)) return sides;
  require_simple(sides);
  turn_if_clockwise(sides, findings);
  return sides;
}

// --- volumes -----------------------------------------------------------------------------------------------

/// Corners of a face in the order of pillar_names.
std::array<Point, 4> corners_of(const Sides& face) {
  return {start_of(face[south]), end_of(face[south]), end_of(face[north]), start_of(face[north])};
}

/// The edge between two corners, in that direction.
Curve pillar(const std::optional<Curve>& given, const std::string& name, const Point& low, const Point& high,
             const Location& where) {
  const double away = distance(low, high);
  if (!given) {
    if (!(away > 0)) throw Error(Fault::usage, "top and bottom meet at " + place_text(low), where);
    return polyline({low, high}, where);
  }
  require_finite(*given, "the edge " + name);
  const bool turned = distance(start_of(*given), high) < distance(start_of(*given), low);
  Curve curve = turned ? reversed(*given) : *given;
  if (distance(start_of(curve), low) + distance(end_of(curve), high) > gap_share * away)
    throw Error(Fault::usage,
                "the edge " + name + " must run from " + place_text(low) + " to " + place_text(high) +
                    ", corners of bottom and top",
                given->where);
  return curve;
}

// --- one outline -------------------------------------------------------------------------------------------

/// The parameter of the place of a curve that is nearest to a point.
double nearest(const Curve& curve, const Point& p) {
  const CurveSamples samples = sample(curve, 4000);
  const auto closest = std::ranges::min_element(samples.points, {}, [&](const Point& q) { return distance(p, q); });
  return samples.t[static_cast<std::size_t>(closest - samples.points.begin())];
}

/// Whether going round from the first one passes the others in their order.
bool goes_round(const std::array<double, 4>& t) {
  const auto after = [&](std::size_t k) { return t[k] > t[0] ? t[k] : t[k] + 1; };
  return after(1) < after(2) && after(2) < after(3) && t[0] != t[1] && t[0] != t[2] && t[0] != t[3];
}

std::array<double, 4> given_corners(const Outline& outline, const Curve& curve, bool turned) {
  std::array<double, 4> t{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Outline::Corner& corner = outline.corners[k];
    t[k] = corner.parameter ? (turned ? 1 - *corner.parameter : *corner.parameter) : nearest(curve, corner.point);
  }
  if (!goes_round(t)) std::swap(t[1], t[3]);
  if (!goes_round(t))
    throw Error(Fault::usage, "the corners do not go round the outline; give four different ones in order",
                outline.corners[0].where);
  return t;
}

Sides cut_outline(const Outline& outline, std::vector<Finding>& findings) {
  Curve curve = outline.curve;
  require_finite(curve, "the outline");
  const double size = size_of({&curve});
  require_length(curve, "the outline", size);
  require_flat(curve, "an outline");
  const Point begin = start_of(curve), end = end_of(curve);
  if (distance(begin, end) > gap_share * size)
    throw Error(Fault::usage,
                "the outline is open: it begins at " + place_text(begin) + " and ends at " + place_text(end),
                curve.where);
  const std::vector<Point> polygon = sample(curve).points;
  if (const auto crossing = first_crossing({polygon.begin(), polygon.end() - 1}))
    throw Error(Fault::usage, "the outline cuts itself at " + place_text(crossing->place), curve.where);
  const bool turned = doubled_area(polygon) < 0;
  if (turned) {
    curve = reversed(curve);
    findings.push_back(turned_finding("the outline went round clockwise; it has been turned"));
  }
  const auto t = outline.corners.empty() ? find_corners(curve) : given_corners(outline, curve, turned);
  return {part(curve, t[0], t[1]), part(curve, t[1], t[2]), reversed(part(curve, t[2], t[3])),
          reversed(part(curve, t[3], t[0]))};
}

// --- rings -------------------------------------------------------------------------------------------------

std::vector<Point> even_points(const Curve& curve, std::size_t count) {
  const CurveSamples samples = sample(curve);
  std::vector<double> t;
  for (std::size_t i = 0; i < count; ++i)
    t.push_back(samples.parameter(samples.total() * static_cast<double>(i) / static_cast<double>(count)));
  return curve.at(t);
}

/// The closed curve begun where it lies best beside the other one.
Curve aligned(const Curve& curve, const Curve& other) {
  constexpr std::size_t count = 360;
  const std::vector<Point> a = even_points(other, count), b = even_points(curve, count);
  std::size_t best = 0;
  double least = -1;
  for (std::size_t shift = 0; shift < count; ++shift) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Point d = difference(a[i], b[(i + shift) % count]);
      sum += dot(d, d);
    }
    if (least < 0 || sum < least * (1 - 1e-9)) {
      least = sum;
      best = shift;
    }
  }
  if (best == 0) return curve;
  const CurveSamples samples = sample(curve);
  const double t = samples.parameter(samples.total() * static_cast<double>(best) / static_cast<double>(count));
  return part(curve, t, t);
}

void require_closed(const Curve& curve, const std::string& name, double size) {
  const Point begin = start_of(curve), end = end_of(curve);
  if (distance(begin, end) > gap_share * size)
    throw Error(Fault::usage,
                name + " of a ring is open: it begins at " + place_text(begin) + " and ends at " + place_text(end),
                curve.where);
}

Sides ring_sides(const Region& region) {
  Sides sides;
  std::array<std::vector<Point>, 4> loop;
  sides[south] = *region.sides[south];
  sides[north] = *region.sides[north];
  const double size = size_of({&sides[south], &sides[north]});
  for (const std::size_t k : {south, north}) {
    require_finite(sides[k], side_name(k));
    require_length(sides[k], side_name(k), size);
    require_flat(sides[k], "a ring");
    require_closed(sides[k], side_name(k), size);
    loop[k] = sample(sides[k], 500).points;
    loop[k].pop_back();
    if (const auto crossing = first_crossing(loop[k]))
      throw Error(Fault::usage, side_name(k) + " cuts itself at " + place_text(crossing->place), sides[k].where);
  }
  const bool outside = std::abs(doubled_area(loop[south])) > std::abs(doubled_area(loop[north]));
  const std::vector<Point>&inner = loop[outside ? north : south], &outer = loop[outside ? south : north];
  if (!std::ranges::all_of(inner, [&](const Point& p) { return contains(outer, p); }))
    throw Error(Fault::usage, "one of the closed sides south and north must lie within the other", sides[north].where);
  // Seen along south, the ring lies to the left.
  for (const std::size_t k : {south, north})
    if ((doubled_area(loop[k]) > 0) != outside) sides[k] = reversed(sides[k]);
  sides[north] = aligned(sides[north], sides[south]);
  return sides;
}

// --- nodes -------------------------------------------------------------------------------------------------

/// Points in space of points of the plane of parameters.
std::vector<Point> mapped(const SurfaceMap* map, const std::vector<Point>& points) {
  return map ? map->at(points).x : points;
}

/// Lengths on the surface, times the root of the attraction: nodes per area become nodes per length.
void measure(CurveSamples& samples, const std::vector<Point>& points, const NodeDensity* attract) {
  std::vector<double> density(points.size(), 1);
  if (attract) density = attract->with_gradient(points)[0];
  for (std::size_t i = 1; i < points.size(); ++i)
    samples.length[i] =
        samples.length[i - 1] + distance(points[i], points[i - 1]) * std::sqrt((density[i] + density[i - 1]) / 2);
}

/// Whether the curve turns by more than a drawn curve's straight pieces do.
bool is_corner(const std::vector<Point>& points, std::size_t i) {
  const Point before = unit(difference(points[i], points[i - 1])), after = unit(difference(points[i + 1], points[i]));
  static const double most = std::cos(std::numbers::pi / 6);
  return dot(before, after) < most;
}

/// Nodes from first to last, some of which are held at lengths along the curve.
struct HeldNode {
  std::int32_t node = 0;
  double length = 0;
};

/// The ends, and the nearest node to every corner for which one is left.
std::vector<HeldNode> held_nodes(const CurveSamples& samples, const std::vector<Point>& points, std::int32_t count) {
  std::vector<HeldNode> held = {{0, 0}};
  const std::int32_t last = count - 1;
  for (const std::size_t knot : samples.knots) {
    if (knot == 0 || knot + 1 == points.size() || !is_corner(points, knot)) continue;
    const double along = samples.length[knot];
    const auto node = static_cast<std::int32_t>(std::lround(along / samples.total() * last));
    if (node > held.back().node && node < last) held.push_back({node, along});
  }
  held.push_back({last, samples.total()});
  return held;
}

std::vector<Point> spread(const Curve& curve, std::int32_t count, const SurfaceMap* map, const NodeDensity* attract) {
  CurveSamples samples = sample(curve, 2000);
  const std::vector<Point> points = mapped(map, samples.points);
  measure(samples, points, attract);
  std::vector<double> t = {0};
  const std::vector<HeldNode> held = held_nodes(samples, points, count);
  for (std::size_t k = 1; k < held.size(); ++k) {
    const HeldNode &from = held[k - 1], &to = held[k];
    for (std::int32_t i = from.node + 1; i <= to.node; ++i) {
      const double share = static_cast<double>(i - from.node) / (to.node - from.node);
      t.push_back(samples.parameter(from.length + share * (to.length - from.length)));
    }
  }
  t.back() = 1;
  return curve.at(t);
}

}  // namespace

std::string place_text(const Point& p) {
  const auto text = [](double x) { return number(std::abs(x) < 1e-12 ? 0 : x); };
  return "(" + text(p[0]) + ", " + text(p[1]) + (std::abs(p[2]) < 1e-12 ? "" : ", " + text(p[2])) + ")";
}

bool is_flat(const Sides& sides, bool ring) {
  for (std::size_t k = 0; k < 4; k += ring ? 2 : 1)
    if (!is_flat(sides[k])) return false;
  return true;
}

void require_enough(const Region& region, const Border& border, const std::array<std::int32_t, 2>& count) {
  std::optional<Crossing> crossing;
  if (!region.ring) crossing = first_crossing(loop_of(border.side));
  for (const std::size_t k : {south, north})
    if (region.ring && !crossing) crossing = first_crossing(border.side[k]);
  if (crossing)
    throw Error(Fault::usage,
                std::to_string(count[0]) + " x " + std::to_string(count[1]) + " nodes cut across the border near " +
                    place_text(crossing->place) + "; take more",
                region.nodes_where);
}

Volume order_edges(const Volume& volume) {
  Volume ordered = volume;
  ordered.bottom = met(volume.bottom);
  ordered.top = met(volume.top);
  const auto low = corners_of(ordered.bottom), high = corners_of(ordered.top);
  for (std::size_t k = 0; k < 4; ++k)
    ordered.pillars[k] = pillar(volume.given[k], pillar_names[k], low[k], high[k], volume.where);
  return ordered;
}

Sides order_sides(const Region& region, std::vector<Finding>& findings) {
  if (region.outline) return cut_outline(*region.outline, findings);
  return region.ring ? ring_sides(region) : four_sides(region, findings);
}

Border make_border(const Region& region, const Sides& sides, const std::array<std::int32_t, 2>& count,
                   const SurfaceMap* map) {
  Border border;
  const NodeDensity* attract = region.attract ? &*region.attract : nullptr;
  for (std::size_t k = 0; k < 4; k += region.ring ? 2 : 1) {
    border.side[k] = spread(sides[k], count[k % 2] + (region.ring ? 1 : 0), map, attract);
    if (region.ring) border.side[k].pop_back();
  }
  if (!region.ring) {  // exactly the same corners
    border.side[west].front() = border.side[south].front();
    border.side[west].back() = border.side[north].front();
    border.side[east].front() = border.side[south].back();
    border.side[east].back() = border.side[north].back();
  }
  return border;
}

}  // namespace pelage

#include "shape/animal.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "shape/remesh.h"

namespace pelage {

namespace {

using Vec = Eigen::Vector3d;
using Mat = Eigen::Matrix3d;

/// Distance-like value and gradient.
struct Distance {
  double value;
  Vec gradient;
};

/// A sphere outside which a part adds nothing: most parts are dismissed by it.
struct Bound {
  Vec centre;
  double radius;
  bool contains(const Vec& p) const { return (p - centre).squaredNorm() < radius * radius; }
};

/// A tapered rod from a to b with round ends. Parts melt together over a width of `blend`, which must not exceed the
/// radii: then the axis, where the distance has a kink, lies where the step is constant.
struct Rod {
  Vec a, b;
  double radius_a, radius_b, blend;
  Bound bound;
};

/// An ellipsoid |to_unit (p - centre)| <= 1 of mean radius `size`.
struct Ball {
  Vec centre;
  Mat to_unit;
  double size, blend;
  Bound bound;
};

struct Body {
  std::vector<Rod> rods;
  std::vector<Ball> balls;
};

/// 0 below -e, x above e, and twice continuously differentiable between. Returns value and derivative.
std::array<double, 2> smooth_ramp(double x, double e) {
  if (x <= -e) return {0, 0};
  if (x >= e) return {x, 1};
  const double u = (x + e) / (2 * e);
  return {2 * e * u * u * u * (1 - u / 2), u * u * (3 - 2 * u)};
}

Distance distance(const Rod& rod, const Vec& p) {
  constexpr double rounding = 0.25;  // of the rod's length: how softly its axis ends
  const Vec axis = rod.b - rod.a;
  const double x = axis.dot(p - rod.a) / axis.squaredNorm();
  const auto [low, low_slope] = smooth_ramp(x, rounding);
  const auto [high, high_slope] = smooth_ramp(x - 1, rounding);
  const double t = low - high;
  const Vec arm = p - rod.a - t * axis;
  const double length = arm.norm();
  if (length == 0) return {-rod.radius_a, Vec::Zero()};
  const Vec dt = (low_slope - high_slope) / axis.squaredNorm() * axis;
  const double taper = rod.radius_b - rod.radius_a;
  return {length - rod.radius_a - t * taper, (arm - axis.dot(arm) * dt) / length - taper * dt};
}

Distance distance(const Ball& ball, const Vec& p) {
  const Vec q = ball.to_unit * (p - ball.centre);
  const double length = q.norm();
  if (length == 0) return {-ball.size, Vec::Zero()};
  return {ball.size * (length - 1), ball.size / length * (ball.to_unit.transpose() * q)};
}

/// Adds the step of one part: 1 inside, 0 outside, 1/2 on its own surface, by the quintic smooth step.
void add_step(const Distance& d, double blend, FieldValue& sum) {
  const double u = (1 - d.value / blend) / 2;
  if (u <= 0) return;
  if (u >= 1) {
    sum.value -= 1;
    return;
  }
  sum.value -= u * u * u * (10 + u * (6 * u - 15));
  const double slope = 30 * u * u * (1 - u) * (1 - u) / (2 * blend);
  for (int k = 0; k < 3; ++k) sum.gradient[k] += slope * d.gradient[k];
}

Rod rod(const Vec& a, const Vec& b, double radius_a, double radius_b, double blend) {
  const double reach = (b - a).norm() / 2 + std::max(radius_a, radius_b) + blend;
  return {a, b, radius_a, radius_b, blend, {(a + b) / 2, reach}};
}

// The last bits of sines and cube roots differ between mathematical libraries, and with them which edges a remeshing
// flips. So that the animal is the same everywhere, angles come as numbers and roots are rounded correctly.

struct Angle {
  double cosine = 1, sine = 0;
};

Mat pitched(const Angle& a) {
  Mat m = Mat::Identity();
  m.topLeftCorner<2, 2>() << a.cosine, -a.sine, a.sine, a.cosine;
  return m;
}

Mat yawed(const Angle& a) {
  Mat m = Mat::Identity();
  m(0, 0) = m(2, 2) = a.cosine;
  m(0, 2) = a.sine;
  m(2, 0) = -a.sine;
  return m;
}

/// A step of Newton's from the library's root, its residual without rounding.
double cube_root(double x) {
  const double y = std::cbrt(x), square = y * y;
  const double residual = std::fma(square, y, -x) + std::fma(y, y, -square) * y;
  return y - residual / (3 * square);
}

/// An ellipsoid whose first axis is turned by `pitch` from +x towards +y and then by `yaw` from +x towards -z.
Ball ball(const Vec& centre, const Vec& radii, double blend, const Angle& pitch = {}, const Angle& yaw = {}) {
  const Mat turn = yawed(yaw) * pitched(pitch);
  const double size = cube_root(radii.prod()), reach = radii.maxCoeff() * (1 + blend / size);
  return {centre, radii.cwiseInverse().asDiagonal() * turn.transpose(), size, blend, {centre, reach}};
}

void add_trunk(Body& body) {
  body.rods.push_back(rod({-0.36, 0.65, 0}, {0.32, 0.68, 0}, 0.265, 0.27, 0.16));
  body.balls.push_back(ball({-0.02, 0.58, 0}, {0.42, 0.25, 0.27}, 0.12));
  body.rods.push_back(rod({0.36, 0.78, 0}, {0.56, 1.03, 0.01}, 0.20, 0.18, 0.14));
}

void add_leg(Body& body, const Vec& shoulder, const Vec& paw, double thickness) {
  const double ankle = 0.85 * thickness;
  body.rods.push_back(rod(shoulder, paw + Vec(-0.03, 0.03, 0), thickness, ankle, 0.105));
  body.balls.push_back(ball(paw + Vec(0.03, 0, 0), {0.145, 0.095, 0.12}, 0.05));
}

void add_legs(Body& body) {
  constexpr double sole = 0.1;  // height of a paw's centre: the soles touch y = 0
  add_leg(body, {0.33, 0.56, 0.155}, {0.42, sole, 0.19}, 0.13);
  add_leg(body, {0.31, 0.56, -0.155}, {0.29, sole, -0.19}, 0.13);
  add_leg(body, {-0.42, 0.46, 0.16}, {-0.50, sole, 0.20}, 0.125);
  add_leg(body, {-0.40, 0.46, -0.16}, {-0.34, sole, -0.20}, 0.125);
  constexpr Angle raised = {0.955336489125606, 0.29552020666133955};  // 0.3 radians
  for (double side : {1.0, -1.0})
    body.balls.push_back(ball({-0.38, 0.54, 0.165 * side}, {0.22, 0.25, 0.15}, 0.09, raised));
}

/// A string of overlapping balls along a cubic Bezier curve, close enough to melt into a smooth tube.
void add_tail(Body& body) {
  const Vec control[4] = {{-0.52, 0.74, 0}, {-0.96, 0.58, 0.02}, {-1.02, 0.98, 0.10}, {-1.08, 1.16, 0.22}};
  constexpr int count = 26;
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count, s = 1 - t;
    const Vec centre =
        s * s * s * control[0] + 3 * s * s * t * control[1] + 3 * s * t * t * control[2] + t * t * t * control[3];
    body.balls.push_back(ball(centre, Vec::Constant(0.052 + 0.016 * t * t), 0.04));
  }
}

/// The head is built around its centre, symmetric in z, and then turned a little towards the viewer.
void add_head(Body& body) {
  const Vec centre(0.67, 1.20, 0.03);
  constexpr Angle yaw = {0.9210609940028851, -0.3894183423086505};      // -0.4 radians
  constexpr Angle pricked = {0.9887710779360422, 0.14943813247359922};  // 0.15
  const Mat turn = yawed(yaw);
  auto add = [&](const Vec& offset, const Vec& radii, double blend, const Angle& pitch = {}) {
    body.balls.push_back(ball(centre + turn * offset, radii, blend, pitch, yaw));
  };
  add({0, 0, 0}, {0.29, 0.275, 0.31}, 0.12);          // skull
  add({0.26, -0.10, 0}, {0.17, 0.115, 0.15}, 0.06);   // muzzle
  add({0.40, -0.055, 0}, {0.045, 0.04, 0.06}, 0.03);  // nose
  for (double side : {1.0, -1.0}) {
    add({0.08, -0.10, 0.18 * side}, {0.14, 0.13, 0.13}, 0.08);               // cheek
    add({-0.05, 0.265, 0.225 * side}, {0.06, 0.125, 0.125}, 0.05, pricked);  // ear
    add({0.235, 0.06, 0.125 * side}, {0.05, 0.06, 0.052}, 0.03);             // eye
  }
}

Body the_body() {
  Body body;
  add_trunk(body);
  add_legs(body);
  add_tail(body);
  add_head(body);
  return body;
}

constexpr Point lower = {-1.3, -0.2, -0.6}, upper = {1.3, 1.7, 0.6};  // a box around it

/// The parts that reach into each of the cells of the box.
class Cells {
 public:
  explicit Cells(const Body& body) : all_(body) {
    for (std::size_t d = 0; d < 3; ++d) count_[d] = static_cast<std::size_t>(std::ceil((upper[d] - lower[d]) / edge));
    for (std::size_t i = 0; i < count_[0] * count_[1] * count_[2]; ++i) {
      const std::size_t x = i % count_[0], y = i / count_[0] % count_[1], z = i / (count_[0] * count_[1]);
      const Vec corner(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
      cells_.push_back(near(Vec(lower.data()) + edge * (corner + Vec::Constant(0.5))));
    }
  }

  /// In the order of the body; outside the box all of them.
  const Body& at(const Point& p) const {
    std::size_t cell = 0;
    for (std::size_t d = 3; d-- > 0;) {
      const double x = (p[d] - lower[d]) / edge;
      if (!(x >= 0 && x < static_cast<double>(count_[d]))) return all_;
      cell = cell * count_[d] + static_cast<std::size_t>(x);
    }
    return cells_[cell];
  }

 private:
  static constexpr double edge = 0.1;

  Body near(const Vec& middle) const {
    const double reach = 0.87 * edge;  // half the diagonal, and a little
    const auto touches = [&](const auto& part) {
      return (part.bound.centre - middle).norm() < part.bound.radius + reach;
    };
    Body parts;
    std::ranges::copy_if(all_.rods, std::back_inserter(parts.rods), touches);
    std::ranges::copy_if(all_.balls, std::back_inserter(parts.balls), touches);
    return parts;
  }

  Body all_;
  std::array<std::size_t, 3> count_;
  std::vector<Body> cells_;
};

}  // namespace

FieldValue animal_field(const Point& place) {
  static const Cells cells(the_body());
  const Vec p(place.data());
  FieldValue sum{0.5, {0, 0, 0}};
  const Body& parts = cells.at(place);
  for (const Rod& rod : parts.rods)
    if (rod.bound.contains(p)) add_step(distance(rod, p), rod.blend, sum);
  for (const Ball& ball : parts.balls)
    if (ball.bound.contains(p)) add_step(distance(ball, p), ball.blend, sum);
  return sum;
}

TriangleMesh animal(std::size_t vertices) {
  constexpr double spacing = 0.03;  // half the radius of the thinnest part, the tail
  const Field field = animal_field;
  const TriangleMesh rough = isosurface(field, lower, upper, spacing);
  return remesh(rough, vertices, [&](const Point& p) { return project_to_surface(field, p, spacing / 2); });
}

}  // namespace pelage

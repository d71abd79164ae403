#include "gridgen/plane_field.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/box.h"
#include "base/suggest.h"
#include "pelage/error.h"
#include "shape/grid.h"
#include "shape/scalar_attributes.h"

namespace pelage {

namespace {

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

VertexAttributes attributes_of(const Grid& sheet) { return scalar_attributes(mesh_of(sheet)); }

void require_plane(const Grid& sheet) {
  Box box;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(sheet.nodes()); ++v) box.add(sheet.point(v));
  constexpr double flat = 1e-9;
  if (sheet.dimension() != 2 || box.high[2] - box.low[2] > flat * box.diagonal())
    throw Error(Fault::input, "the grid of a field must be a sheet in the plane of x and y");
}

/// Numbers on a raster of which some are not known yet.
class Raster {
 public:
  Raster(std::int32_t nx, std::int32_t ny) : nx_(nx), ny_(ny), value_(index(nx) * index(ny)) {}

  /// Linear between the corners [steps of the raster] of a triangle.
  void fill(const std::array<std::array<double, 2>, 3>& p, const std::array<double, 3>& value) {
    const auto area = [](const auto& a, const auto& b, const auto& c) {
      return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    };
    const double whole = area(p[0], p[1], p[2]);
    if (whole == 0) return;
    const auto [left, right] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [low, high] = std::minmax({p[0][1], p[1][1], p[2][1]});
    for (auto j = first(low, ny_); j <= last(high, ny_); ++j)
      for (auto i = first(left, nx_); i <= last(right, nx_); ++i) {
        const std::array<double, 2> here = {static_cast<double>(i), static_cast<double>(j)};
        const double a = area(here, p[1], p[2]) / whole, b = area(p[0], here, p[2]) / whole, c = 1 - a - b;
        constexpr double slack = -1e-9;  // places on edges belong to both triangles
        if (std::min({a, b, c}) >= slack) value_[index(i + nx_ * j)] = a * value[0] + b * value[1] + c * value[2];
      }
  }
  /// What is not known is as the nearest that is, in steps along the axes.
  std::vector<double> completed() {
    std::vector<std::int32_t> front;
    for (std::int32_t v = 0; v < nx_ * ny_; ++v)
      if (value_[index(v)]) front.push_back(v);
    for (std::size_t k = 0; k < front.size(); ++k) {
      const std::int32_t i = front[k] % nx_, j = front[k] / nx_;
      for (const auto& [di, dj] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (i + di < 0 || i + di >= nx_ || j + dj < 0 || j + dj >= ny_) continue;
        const std::int32_t next = i + di + nx_ * (j + dj);
        if (value_[index(next)]) continue;
        value_[index(next)] = value_[index(front[k])];
        front.push_back(next);
      }
    }
    std::vector<double> values;
    for (const std::optional<double>& v : value_) values.push_back(v.value_or(0));
    return values;
  }

 private:
  static std::int32_t first(double x, std::int32_t n) {
    return static_cast<std::int32_t>(std::clamp(std::ceil(x - 1e-6), 0.0, static_cast<double>(n)));
  }
  static std::int32_t last(double x, std::int32_t n) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x + 1e-6), -1.0, n - 1.0));
  }
  std::int32_t nx_, ny_;
  std::vector<std::optional<double>> value_;
};

}  // namespace

std::vector<std::string> names_read(const Grid& sheet, const std::string& formula) {
  std::vector<std::string> names;
  for (const auto& [name, values] : attributes_of(sheet))
    if (formula.find("attribute(" + name + ")") != std::string::npos) names.push_back(name);
  return names;
}

PlaneField::PlaneField(const Grid& sheet, std::vector<std::string> names) : names_(std::move(names)) {
  require_plane(sheet);
  const VertexAttributes attributes = attributes_of(sheet);
  for (const std::string& name : names_)
    if (!attributes.contains(name)) throw Error(Fault::input, "the grid has no attribute " + name);
  if (sheet.even()) {
    for (std::size_t k = 0; k < 2; ++k)
      axis_[k] = {sheet.count[k], sheet.periodic[k], sheet.origin[k], sheet.spacing[k]};
    for (const std::string& name : names_) values_.push_back(attributes.at(name));
    return;
  }
  const TriangleMesh mesh = mesh_of(sheet);
  const Box box = box_of(mesh.points);
  constexpr double steps = 256;
  const double step = std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]) / steps;
  if (!(step > 0 && std::isfinite(step)))
    throw Error(Fault::input, "the grid of a field has no extent, or too large a one");
  for (std::size_t k = 0; k < 2; ++k)
    axis_[k] = {static_cast<std::int32_t>(std::ceil((box.high[k] - box.low[k]) / step)) + 1, false, box.low[k], step};
  for (const std::string& name : names_) {
    Raster raster(axis_[0].count, axis_[1].count);
    const std::vector<double>& values = attributes.at(name);
    for (const Triangle& t : mesh.triangles) {
      std::array<std::array<double, 2>, 3> corner;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 2; ++k) corner[c][k] = (mesh.points[index(t[c])][k] - axis_[k].first) / step;
      raster.fill(corner, {values[index(t[0])], values[index(t[1])], values[index(t[2])]});
    }
    values_.push_back(raster.completed());
  }
}

void PlaneField::lay_between(const std::array<double, 2>& low, const std::array<double, 2>& high) {
  for (std::size_t k = 0; k < 2; ++k) {
    axis_[k].first = low[k];
    axis_[k].step = (high[k] - low[k]) / std::max(1, axis_[k].count - 1);
  }
}

PlaneField::Weights PlaneField::weights(const Axis& axis, double x) {
  double place = (x - axis.first) / axis.step;
  if (std::isnan(place)) place = 0;
  if (axis.periodic)
    place = std::isinf(place) ? 0 : std::fmod(place, axis.count);
  else
    place = std::clamp(place, -2.0, axis.count + 1.0);  // from there on nothing changes
  const double before = std::floor(place), t = place - before, s = 1 - t;
  Weights w{{},
            {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6},
            {-s * s / 2, (-4 * t + 3 * t * t) / 2, (4 * s - 3 * s * s) / 2, t * t / 2}};
  for (std::size_t k = 0; k < 4; ++k) {
    const double n = axis.count, index = before + static_cast<double>(k) - 1;
    w.index[k] =
        static_cast<std::size_t>(axis.periodic ? index - n * std::floor(index / n) : std::clamp(index, 0.0, n - 1));
    w.slope[k] /= axis.step;
  }
  return w;
}

PlaneField::Value PlaneField::at(std::size_t name, double x, double y) const {
  const Weights along = weights(axis_[0], x), up = weights(axis_[1], y);
  Value result{0, 0, 0};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const double c = values_[name][along.index[i] + static_cast<std::size_t>(axis_[0].count) * up.index[j]];
      result.value += along.value[i] * up.value[j] * c;
      result.dx += along.slope[i] * up.value[j] * c;
      result.dy += along.value[i] * up.slope[j] * c;
    }
  return result;
}

}  // namespace pelage

#include "run/anisotropy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/parallel.h"
#include "direction/direction_field.h"
#include "pelage/error.h"
#include "run/place_fields.h"
#include "run/program.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Tensor square(const Point& d) { return {d[0] * d[0], d[0] * d[1], d[0] * d[2], d[1] * d[1], d[1] * d[2], d[2] * d[2]}; }

Point times(const Tensor& t, const Point& a) {
  return {t[0] * a[0] + t[1] * a[1] + t[2] * a[2], t[1] * a[0] + t[3] * a[1] + t[4] * a[2],
          t[2] * a[0] + t[4] * a[1] + t[5] * a[2]};
}

/// Any unit vector across n.
Point some_tangent(const Point& n) {
  const Point axis = std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  return unit(cross(n, axis));
}

Point turned(const Point& e, const Point& f, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * e[0] + s * f[0], c * e[1] + s * f[1], c * e[2] + s * f[2]};
}

/// The tangent line nearest to a mean of lines: the first eigenvector of its tangential part.
Point mean_line(const Tensor& t, const Point& n) {
  const Point e = some_tangent(n), f = cross(n, e);
  const double ee = dot(e, times(t, e)), ef = dot(e, times(t, f)), ff = dot(f, times(t, f));
  return turned(e, f, std::atan2(2 * ef, ee - ff) / 2);
}

/// The attribute as three components: in one, or in three as PLY files have them.
std::optional<std::array<std::vector<double>, 3>> given_directions(const TriangleMesh& shape) {
  const VertexAttributes all = scalar_attributes(shape.attributes);
  for (const int first : {1, 0}) {
    std::array<std::vector<double>, 3> parts;
    bool complete = true;
    for (int k = 0; k < 3; ++k) {
      const auto found = all.find(direction_attribute + ("_" + std::to_string(first + k)));
      complete = complete && found != all.end();
      if (complete) parts[static_cast<std::size_t>(k)] = found->second;
    }
    if (complete) return parts;
  }
  if (shape.find(direction_attribute))
    throw Error(Fault::input, std::string("the attribute \"") + direction_attribute +
                                  "\" of the mesh must be a vector of 3 components per vertex");
  return std::nullopt;
}

std::vector<Point> directions(const TriangleMesh& shape, const std::optional<FieldWish>& wish) {
  const auto given = wish ? std::nullopt : given_directions(shape);
  if (!given) {
    const Connection c = make_connection(make_topology(shape.points.size(), shape.triangles), shape.points);
    const double diagonal = bounding_diagonal(shape);
    return direction_field(c, 2, find_guides(wish.value_or(FieldWish{}), c, shape.points, diagonal)).direction;
  }
  const auto& [x, y, z] = *given;
  std::vector<Point> list;
  for (std::size_t i = 0; i < x.size(); ++i) list.push_back(unit({x[i], y[i], z[i]}));
  return list;
}

Tensor tensor(const Point& d, const Point& normal, double along, double across) {
  Tensor t = square(d);
  const Tensor other = square(cross(normal, d));
  for (std::size_t k = 0; k < 6; ++k) t[k] = along * along * t[k] + across * across * other[k];
  return t;
}

}  // namespace

std::vector<Tensor> vertex_lines(const TriangleMesh& shape, const std::optional<FieldWish>& wish, int levels) {
  VertexAttributes parts;
  for (const Point& d : directions(shape, wish)) {
    const Tensor t = square(d);
    for (std::size_t k = 0; k < 6; ++k) parts[std::to_string(k)].push_back(t[k]);
  }
  parts = refined(shape, std::move(parts), levels);
  std::vector<Tensor> lines(parts["0"].size());
  for (std::size_t v = 0; v < lines.size(); ++v)
    for (std::size_t k = 0; k < 6; ++k) lines[v][k] = parts[std::to_string(k)][v];
  return lines;
}

std::vector<Tensor> quadrature_tensors(const Discretisation& d, const std::vector<Point>& control,
                                       const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) {
  const std::vector<Point> normal = quadrature_geometry(d, control).normal;
  std::vector<Tensor> result(normal.size());
  parallel_for(d.elements(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const ElementClass& c = d.classes[at(d.element_class[e])];
      for (std::size_t k = 0; k < c.place.size(); ++k) {
        const auto [v, w] = c.place[k];
        const std::size_t q = static_cast<std::size_t>(d.first_point[e]) + k;
        Tensor mean{};
        for (std::size_t corner = 0; corner < 3; ++corner)
          for (std::size_t i = 0; i < 6; ++i)
            mean[i] += std::array{1 - v - w, v, w}[corner] * lines[at(d.topology.triangles[e][corner])][i];
        const Point line = mean_line(mean, normal[q]);
        result[q] = tensor(turned(line, cross(normal[q], line), rates.theta[q]), normal[q], rates.a1[q], rates.a2[q]);
      }
    }
  });
  return result;
}

double largest_ratio(const Kinetics::TensorField& rates) {
  double ratio = 1;
  for (std::size_t i = 0; i < rates.a1.size(); ++i) {
    const double a = std::abs(rates.a1[i]), b = std::abs(rates.a2[i]);
    if (std::max(a, b) > 0) ratio = std::max(ratio, std::max(a, b) / std::min(a, b));
  }
  return ratio;
}

}  // namespace pelage

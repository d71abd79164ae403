#pragma once
// Coats that are known everywhere, on shapes with uv.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "discretise/surface_evaluator.h"
#include "look/bake.h"
#include "look/viewer.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {

using Field = double (*)(const Point&);

/// The built-in torus with its two angles as uv, which has seams along both.
inline TriangleMesh torus(int vertices) {
  TriangleMesh mesh = builtin_shape("builtin:torus?n=" + std::to_string(vertices));
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 2> first{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = mesh.points[static_cast<std::size_t>(t[k])];
      std::array<double, 2> turns = {std::atan2(p[1], p[0]) / (2 * std::numbers::pi) + 0.5,
                                     std::atan2(p[2], std::hypot(p[0], p[1]) - 1) / (2 * std::numbers::pi) + 0.5};
      if (k == 0) first = turns;
      for (std::size_t c = 0; c < 2; ++c) {
        turns[c] -= std::round(turns[c] - first[c]);
        uv.values.push_back(0.1 + 0.7 * turns[c]);
      }
    }
  }
  mesh.set(std::move(uv));
  return mesh;
}

/// A field "u" on an even mesh of its own, as runs have it, or on the Loop elements of the shape.
struct Coat {
  CoatFields fields;
  Hierarchy levels;
  std::vector<Point> control;

  Coat(TriangleMesh shape, const Method& method, double edge, Field field)
      : levels(make_topology(shape.points.size(), shape.triangles), method.refine), control(shape.points) {
    if (method.own_mesh) {
      fields.mesh = std::make_shared<const SimulationMesh>(levels, control, SimulationMesh::Edge{edge, {}}, 1'000'000);
      fields.space = method.make_space(fields.mesh->shared_topology(), fields.mesh->points(control));
    } else {
      fields.space = method.make_space(levels.shared_topology(0), control);
    }
    fields.points = shape.points;
    fields.shape = std::make_shared<const TriangleMesh>(std::move(shape));
    fields.hierarchy = std::make_shared<const Hierarchy>(levels);
    fields.method = &method;
    fields.control = control;
    fields.species = {"u"};
    fields.uniform = {0};
    fields.wavelength = 12 * edge;
    const SampledMass mass = fields.space->sampled(SampleRule::vertices);
    Vector samples(mass.sampling->count());
    for (Eigen::Index i = 0; i < samples.size(); ++i)
      samples[i] = field(mass.sampling->position[static_cast<std::size_t>(i)]);
    const Vector u = coefficients_from_samples(*mass.sampling, *mass.mass, samples);
    fields.coefficients.emplace_back(u.begin(), u.end());
  }

  /// The limit surface of the shape itself, without the mesh of the fields.
  SurfaceEvaluator surface() const {
    const TriangleMesh& shape = *fields.shape;
    return SurfaceEvaluator(loop_method.make_space(levels.shared_topology(0), shape.points), 0, {});
  }
};

inline BakedCoat baked(const Coat& coat, const Look& look, int size, bool normals = false) {
  const Paint paint = resolve_paint(look, coat.fields.species);
  const Tessellation t = tessellate(coat.fields, tessellation_request(look, paint));
  const TriangleMesh& shape = *coat.fields.shape;
  const UvLayout layout(shape.triangles, *shape.find("uv"), size);
  const ShadingFrames frames(shape);
  return bake(CoatSampler(coat.fields, t, paint), make_palette(paint, t.samples, coat.fields.uniform), layout,
              normals ? &frames : nullptr);
}

/// visit(place, uv) for places spread evenly over the mesh; every third one on an edge, where the seams are.
template <class Visit>
void at_random_places(const TriangleMesh& mesh, std::size_t count, const Visit& visit) {
  const Attribute& uv = *mesh.find("uv");
  std::vector<double> area_until;
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
    area += length(cross(difference(corner(1), corner(0)), difference(corner(2), corner(0))));
    area_until.push_back(area);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto face =
        static_cast<std::size_t>(std::ranges::lower_bound(area_until, uniform(i, 2) * area) - area_until.begin());
    double v = uniform(i, 0), w = i % 3 == 0 ? 0 : uniform(i, 1);
    if (v + w > 1) v = 1 - v, w = 1 - w;
    std::array<double, 2> at{};
    for (std::size_t c = 0; c < 2; ++c)
      for (const auto& [k, share] : {std::pair{0, 1 - v - w}, {1, v}, {2, w}})
        at[c] += share * uv.values[2 * (3 * face + static_cast<std::size_t>(k)) + c];
    visit(MeshPlace{static_cast<Index>(face), v, w}, at);
  }
}

}  // namespace pelage

#include "look/coat_sampler.h"

#include <algorithm>

#include "base/suggest.h"
#include "look/onto_mesh.h"
#include "pelage/cells.h"
#include "shape/locate.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

bool reads(const Paint& paint, std::size_t species) {
  return species == paint.shown || std::ranges::any_of(paint.symbols(), [&](const Symbol& s) {
           return s.kind == Symbol::Kind::attribute && matching_name(s.name, {paint.species[species]});
         });
}

}  // namespace

CoatSampler::CoatSampler(const CoatFields& fields, const Tessellation& tessellation, const Paint& paint,
                         const OntoMesh* onto)
    : fields_(fields),
      t_(tessellation),
      onto_(onto),
      shared_(without_samples(tessellation.samples)),
      smooth_(!fields.nodes && fields.method->smooth) {
  for (std::size_t i = 0; i < fields.species.size(); ++i) needed_.push_back(reads(paint, i));
  for (std::size_t faces = triangles().size(); faces < t_.triangles.size(); faces *= 4) ++levels_;
  if (fields.mesh) {
    const Topology& mesh = *fields.mesh->shared_topology();
    walk_ = std::make_unique<const SurfaceWalk>(mesh, fields.space->control());
    anywhere_ = std::make_unique<const MeshFields>(mesh, fields.space->control(), fields.coefficients);
  } else if (smooth_ && t_.creased) {
    anywhere_ = std::make_unique<const MeshFields>(*t_.creased, t_.samples.position, t_.samples.fields);
  } else if (smooth_) {
    anywhere_ = std::make_unique<const MeshFields>(t_.triangles, t_.samples.position, t_.samples.fields);
  }
}

CoatSampler::~CoatSampler() = default;

const std::vector<Triangle>& CoatSampler::triangles() const {
  const Cells* cells = as<Cells>(fields_.nodes);
  return cells ? cells->on->triangles : fields_.shape->triangles;
}

CoatSampler::Spot CoatSampler::spot_of(MeshPlace place, Index near) const {
  if (onto_) {
    const MeshPlace on_coat = onto_->on_coat(place, near);
    return {at(on_coat.face), on_coat.v, on_coat.w, 0, 0};
  }
  double v = std::max(place.v, 0.0), w = std::max(place.w, 0.0);
  if (v + w > 1) {
    const double sum = v + w;
    v /= sum;
    w = 1 - v;
  }
  double beyond_v = place.v - v, beyond_w = place.w - w;
  MeshPlace fine{place.face, v, w};
  for (int level = 0; level < levels_; ++level) {
    fine = in_child(fine);
    const double factor = fine.face % 4 == 3 ? -2 : 2;
    beyond_v *= factor;
    beyond_w *= factor;
  }
  return {at(fine.face), fine.v, fine.w, beyond_v, beyond_w};
}

MeshPlace CoatSampler::on_tessellation(const MeshPlace& place, const SurfaceWalk& walk) const {
  const Spot spot = spot_of(place);
  const MeshPlace within{static_cast<Index>(spot.face), spot.v, spot.w};
  if (spot.beyond_v == 0 && spot.beyond_w == 0) return within;
  const Point p = moved_beyond(point_at(t_.triangles, t_.samples.position, within), spot);
  return walk.closest(Eigen::Vector3d(p.data()), within.face);
}

Point CoatSampler::moved_beyond(Point p, const Spot& s) const {
  const Triangle& t = t_.triangles[s.face];
  const std::vector<Point>& points = t_.samples.position;
  const Point &a = points[at(t[0])], &b = points[at(t[1])], &c = points[at(t[2])];
  for (std::size_t k = 0; k < 3; ++k) p[k] += s.beyond_v * (b[k] - a[k]) + s.beyond_w * (c[k] - a[k]);
  return p;
}

Point CoatSampler::position(const Spot& s) const {
  const auto [a, b, c] = t_.triangles[s.face];
  const std::vector<Point>& points = t_.samples.position;
  const MeshPlace place{static_cast<Index>(s.face), s.v, s.w};
  Point p = smooth_ ? smooth_point({points[at(a)], points[at(b)], points[at(c)]},
                                   {t_.normal(s.face, 0), t_.normal(s.face, 1), t_.normal(s.face, 2)}, s.v, s.w)
                    : point_at(t_.triangles, points, place);
  return walk_ ? moved_beyond(p, s) : p;
}

Point CoatSampler::normal(const Spot& s) const {
  const Point &a = t_.normal(s.face, 0), &b = t_.normal(s.face, 1), &c = t_.normal(s.face, 2);
  Point n;
  for (std::size_t k = 0; k < 3; ++k) n[k] = (1 - s.v - s.w) * a[k] + s.v * b[k] + s.w * c[k];
  return unit(n);
}

/// Of the mesh of the fields.
Index CoatSampler::near_face(const Spot& s) const {
  const std::size_t corner = s.v >= s.w ? (s.v > 0.5 ? 1 : 0) : (s.w > 0.5 ? 2 : 0);
  return walk_ ? t_.on_mesh[at(t_.triangles[s.face][corner])].face : -1;
}

MeshPlace CoatSampler::field_place(const Spot& s, const Point& position, Index near) const {
  if (!walk_) return {static_cast<Index>(s.face), s.v, s.w};
  return walk_->closest(Eigen::Vector3d(position.data()), near);
}

double CoatSampler::field(std::size_t i, const MeshPlace& place) const {
  return anywhere_ ? anywhere_->at(i, place) : value_at(t_.triangles, t_.samples.fields[i], place);
}

CoatSamples CoatSampler::samples(std::span<const MeshPlace> places) const {
  const CoatSamples& from = t_.samples;
  CoatSamples s = shared_;
  s.fields.resize(needed_.size());
  for (std::size_t f = 0; f < needed_.size(); ++f) s.fields[f].resize(needed_[f] ? places.size() : 0);
  std::vector<MeshPlace> linear;
  linear.reserve(places.size());
  for (auto* points : {&s.position, &s.normal}) points->reserve(places.size());
  MeshPlace on_fields;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Spot spot = spot_of(places[i], i > 0 ? linear[i - 1].face : -1);
    const MeshPlace& fine = linear.emplace_back(MeshPlace{static_cast<Index>(spot.face), spot.v, spot.w});
    s.position.push_back(position(spot));
    s.normal.push_back(normal(spot));
    if (!from.drawn_at.empty()) s.drawn_at.push_back(point_at(t_.triangles, from.drawn_at, fine));
    // Neighbours in a row of texels are neighbours on the surface.
    const bool goes_on = i > 0 && linear[i - 1].face == fine.face;
    on_fields = field_place(spot, s.position.back(), goes_on ? on_fields.face : near_face(spot));
    for (std::size_t f = 0; f < needed_.size(); ++f)
      if (needed_[f]) s.fields[f][i] = field(f, on_fields);
  }
  const auto interpolated = [&](const std::vector<double>& values) {
    std::vector<double> result;
    result.reserve(values.empty() ? 0 : linear.size());
    for (const MeshPlace& place : linear)
      if (!values.empty()) result.push_back(value_at(t_.triangles, values, place));
    return result;
  };
  s.curvature = {interpolated(from.curvature.k1), interpolated(from.curvature.k2)};
  for (const auto& [name, values] : from.attributes) s.attributes[name] = interpolated(values);
  return s;
}

}  // namespace pelage

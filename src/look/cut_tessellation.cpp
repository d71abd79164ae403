#include "look/cut_tessellation.h"

#include <algorithm>
#include <utility>

#include "look/solid_tessellation.h"
#include "shape/refine.h"
#include "shape/split_along.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Of the range of an opacity: the lines along which a layer begins and ends...
constexpr double begin = 0.03, end = 0.97;
/// ... where it changes by more than this between neighbours. What changes less shows no teeth.
constexpr double least_jump = 0.08;
/// Of the edges of the surface: what is shorter is not cut again, so that triangles keep some area.
constexpr double shortest_cut = 0.15;

std::vector<double> opacity_at(const CoatSamples& samples, const PaintLayer& layer, const Paint& paint) {
  std::vector<double> values = formula_values(*layer.opacity, samples, paint);
  for (double& x : values) x = x > 0 ? std::min(x, 1.0) : 0;
  return values;
}

Tessellation cut_along(const Tessellation& t, const PaintLayer& layer, const Paint& paint) {
  const std::vector<double> opacity = opacity_at(t.samples, layer, paint);
  const auto [low, high] = std::ranges::minmax(opacity);
  const double shortest = shortest_cut * prevailing_edge(t.triangles, t.samples.position);
  Tessellation result = t;
  // One line has its vertices before the layer, the other one within it, also where the opacity jumps.
  for (const auto& [share, sign] : {std::pair{begin, 1}, {end, -1}}) {
    const double line = low + share * (high - low);
    const LevelFunction level = [&, sign = sign](const std::vector<CutPlace>& places) {
      CutSurface at;
      at.vertex = places;
      std::vector<double> values = opacity_at(samples_at(result.samples, at), layer, paint);
      for (double& x : values) x = sign * (x - line);
      return values;
    };
    const CutSurface cut =
        split_along(result.triangles, result.samples.position, level, {least_jump * (high - low), shortest});
    if (cut.vertex.size() > result.samples.size()) result = cut_tessellation(result, cut);
  }
  return result;
}

}  // namespace

CoatSamples samples_at(const CoatSamples& s, const CutSurface& at) {
  CoatSamples result = without_samples(s);
  result.position = at.at_vertices(s.position);
  result.normal = at.at_vertices(s.normal);
  for (Point& n : result.normal) n = unit(n);
  if (!s.curvature.k1.empty()) result.curvature = {at.at_vertices(s.curvature.k1), at.at_vertices(s.curvature.k2)};
  for (const std::vector<double>& field : s.fields) result.fields.push_back(at.at_vertices(field));
  for (const auto& [name, values] : s.attributes) result.attributes[name] = at.at_vertices(values);
  if (!s.drawn_at.empty()) result.drawn_at = at.at_vertices(s.drawn_at);
  return result;
}

Tessellation cut_tessellation(const Tessellation& t, const CutSurface& into) {
  Tessellation result{into.triangles, samples_at(t.samples, into), {}, t.links, t.metres_per_unit, t.sharp};
  for (const Attribute& a : t.attributes) result.attributes.push_back(into.of(a));
  return result;
}

Tessellation cut_along_layers(Tessellation t, const Paint& paint) {
  if (!t.samples.box) t.samples.box = box_of(t.samples.position);
  for (const PaintLayer& layer : paint.layers)
    if (layer.opacity) t = cut_along(t, layer, paint);
  return t;
}

bool may_be_cut(const CoatFields& fields, const Look& look) {
  const bool own_nodes = fields.nodes && !as<Cells>(fields.nodes) && !shows_surface(fields.nodes);
  return !look.keep_shape && !look.detail && !own_nodes;
}

Tessellation tessellate_for(const CoatFields& fields, const Look& look, const Paint& paint) {
  Tessellation t = tessellate(fields, tessellation_request(look, paint));
  return may_be_cut(fields, look) ? cut_along_layers(std::move(t), paint) : t;
}

}  // namespace pelage

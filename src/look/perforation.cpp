#include "look/perforation.h"

#include <algorithm>

#include "base/number.h"
#include "pelage/error.h"
#include "print/perforate.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// What samples have, at other places; vectors of unit length stay such.
CoatSamples samples_at(const CoatSamples& s, const PerforatedSurface& at) {
  CoatSamples result = s;
  if (!result.box) result.box = box_of(s.position);
  result.position = at.at_vertices(s.position);
  result.normal = at.at_vertices(s.normal);
  for (Point& n : result.normal) n = unit(n);
  if (!s.curvature.k1.empty()) result.curvature = {at.at_vertices(s.curvature.k1), at.at_vertices(s.curvature.k2)};
  for (std::vector<double>& field : result.fields) field = at.at_vertices(field);
  for (auto& [name, values] : result.attributes) values = at.at_vertices(values);
  if (!s.drawn_at.empty()) result.drawn_at = at.at_vertices(s.drawn_at);
  return result;
}

/// "b lies between 0.2 and 0.9", of the species that the condition reads.
std::string ranges(const CoatSamples& samples, const Paint& paint) {
  std::string text;
  const std::vector<Symbol> read = paint.holes->value.symbols();
  for (std::size_t i = 0; i < paint.species.size(); ++i) {
    const std::string& name = paint.species[i];
    if (std::ranges::none_of(read, [&](const Symbol& s) { return s.name == name; })) continue;
    const auto [low, high] = std::ranges::minmax(samples.fields[i]);
    text += (text.empty() ? ": " : ", ") + name + " lies between " + number(low) + " and " + number(high);
  }
  return text;
}

}  // namespace

Perforated with_holes(const Tessellation& t, const Paint& paint) {
  const LevelFunction level = [&](const std::vector<CutPlace>& places) {
    PerforatedSurface at;
    at.vertex = places;
    return hole_values(samples_at(t.samples, at), paint);
  };
  const PerforatedSurface left = perforated(t.triangles, t.samples.position, level);
  const bool nowhere = left.islands == 0 && std::ranges::all_of(left.vertex, [](auto& p) { return p.from == p.to; }) &&
                       left.triangles.size() == t.triangles.size();
  if (nowhere || left.triangles.empty())
    throw Error(
        Fault::usage,
        std::string("the condition for holes holds ") + (nowhere ? "nowhere" : "everywhere") + ranges(t.samples, paint),
        paint.holes->where);
  Perforated result{t, left.islands, left.island_area / (left.area + left.island_area)};
  result.tessellation.triangles = left.triangles;
  result.tessellation.samples = samples_at(t.samples, left);
  for (Attribute& a : result.tessellation.attributes) a = left.of(a);
  result.tessellation.on_mesh.clear();
  return result;
}

}  // namespace pelage

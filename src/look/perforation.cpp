#include "look/perforation.h"

#include <algorithm>

#include "base/number.h"
#include "look/cut_tessellation.h"
#include "pelage/error.h"
#include "print/perforate.h"

namespace pelage {

namespace {

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
    CutSurface at;
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
  return {cut_tessellation(t, left), left.islands, left.island_area / (left.area + left.island_area)};
}

}  // namespace pelage

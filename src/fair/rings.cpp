#include "fair/rings.h"

#include <algorithm>

namespace pelage {

namespace {

/// A vertex of more faces than this is near its neighbours, but does not bring them together: the work would grow with
/// the square of their number.
constexpr std::int32_t many_around = 64;

}  // namespace

TwoRings::TwoRings(const Topology& topology, const std::vector<char>& fixed)
    : topology_(topology), fixed_(fixed), faces_(topology.vertex_count, 0) {
  for (const Triangle& t : topology.triangles)
    for (const Index v : t) ++faces_[v];
}

void TwoRings::around(Index v, std::vector<Index>& near) const {
  std::vector<Index> ring;
  topology_.one_ring(v, near);
  for (std::size_t k = 0, first = near.size(); k < first; ++k) {
    if (faces_[near[k]] > many_around) continue;
    topology_.one_ring(near[k], ring);
    near.insert(near.end(), ring.begin(), ring.end());
  }
  std::erase_if(near, [&](Index w) { return w == v || fixed_[w]; });
  near.push_back(v);
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
}

}  // namespace pelage

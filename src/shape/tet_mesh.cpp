#include "shape/tet_mesh.h"

#include <algorithm>
#include <cmath>

namespace pelage {

namespace {

/// The side opposite to each corner, counter-clockwise from outside.
constexpr std::array<std::array<std::size_t, 3>, 4> sides = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct Side {
  Triangle sorted, turned;
};

}  // namespace

const Attribute* TetMesh::find(std::string_view name) const {
  const auto it = std::ranges::find(attributes, name, &Attribute::name);
  return it == attributes.end() ? nullptr : &*it;
}

void TetMesh::set(Attribute attribute) {
  const auto it = std::ranges::find(attributes, attribute.name, &Attribute::name);
  if (it == attributes.end())
    attributes.push_back(std::move(attribute));
  else
    *it = std::move(attribute);
}

double mean_edge(const TetMesh& volume) {
  double sum = 0;
  for (const Tetrahedron& t : volume.tets)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < k; ++l) {
        const Point &a = volume.points[static_cast<std::size_t>(t[k])],
                    &b = volume.points[static_cast<std::size_t>(t[l])];
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      }
  return sum / static_cast<double>(6 * volume.tets.size());
}

TriangleMesh mesh_of(const TetMesh& volume) {
  TriangleMesh mesh{volume.points, {}, volume.attributes, {}, volume.metres_per_unit};
  std::vector<Side> all;
  all.reserve(4 * volume.tets.size());
  for (const Tetrahedron& t : volume.tets)
    for (const auto& side : sides) {
      const Triangle turned = {t[side[0]], t[side[1]], t[side[2]]};
      Triangle sorted = turned;
      std::ranges::sort(sorted);
      all.push_back({sorted, turned});
    }
  std::ranges::sort(all, {}, &Side::sorted);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool shared =
        (k > 0 && all[k - 1].sorted == all[k].sorted) || (k + 1 < all.size() && all[k + 1].sorted == all[k].sorted);
    if (!shared) mesh.triangles.push_back(all[k].turned);
  }
  return mesh;
}

}  // namespace pelage

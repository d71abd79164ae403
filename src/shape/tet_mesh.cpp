#include "shape/tet_mesh.h"

#include <algorithm>
#include <cmath>

#include "shape/numbered_mesh.h"

namespace pelage {

namespace {

/// The side opposite to a corner of a tetrahedron.
struct Side {
  Triangle sorted;
  std::int32_t tet, corner;
};

Triangle turned(const Tetrahedron& t, std::size_t corner) {
  const auto& side = tet_sides[corner];
  return {t[side[0]], t[side[1]], t[side[2]]};
}

/// Those of one tetrahedron alone, in the order of their nodes.
std::vector<Side> skin_of(const std::vector<Tetrahedron>& tets) {
  std::vector<Side> all, skin;
  all.reserve(4 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t corner = 0; corner < 4; ++corner) {
      Triangle sorted = turned(tets[t], corner);
      std::ranges::sort(sorted);
      all.push_back({sorted, static_cast<std::int32_t>(t), static_cast<std::int32_t>(corner)});
    }
  std::ranges::sort(all, {}, &Side::sorted);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool shared =
        (k > 0 && all[k - 1].sorted == all[k].sorted) || (k + 1 < all.size() && all[k + 1].sorted == all[k].sorted);
    if (!shared) skin.push_back(all[k]);
  }
  return skin;
}

}  // namespace

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
  for (const Side& side : skin_of(volume.tets))
    mesh.triangles.push_back(
        turned(volume.tets[static_cast<std::size_t>(side.tet)], static_cast<std::size_t>(side.corner)));
  return mesh;
}

TriangleMesh skin_mesh(const TetMesh& volume) {
  NumberedMesh skin{mesh_of(volume), {}, {}};
  skin.vertex_number.resize(skin.mesh.points.size());
  drop_unused_vertices(skin);
  return std::move(skin.mesh);
}

std::vector<std::uint8_t> skin_sides(const TetMesh& volume) {
  std::vector<std::uint8_t> sides(volume.tets.size());
  for (const Side& side : skin_of(volume.tets))
    sides[static_cast<std::size_t>(side.tet)] |= static_cast<unsigned char>(1U << side.corner);
  return sides;
}

}  // namespace pelage

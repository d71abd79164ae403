// Stencils against geometry: they fill exactly what is inside, fit their neighbours and have good angles.

#include "solid/stencil.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/random.h"
#include "shape/tet_quality.h"
#include "solid/bcc_lattice.h"

namespace pelage {
namespace {

BccLattice small_lattice() {
  BccLattice lattice;
  lattice.count = {7, 7, 7};
  return lattice;
}

double random(std::uint64_t& key) { return uniform(11, key++); }

Point between(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

TEST(BccLattice, TetrahedraAreCongruentAndEdgesHaveTheirNumbers) {
  const BccLattice lattice = small_lattice();
  std::array<std::int64_t, 4> n;
  int count = 0;
  for (std::int64_t corner = 0; corner < lattice.corners(); ++corner)
    for (int k = 0; k < BccLattice::tets_per_cube; ++k) {
      if (!lattice.tetrahedron(corner, k, n)) continue;
      ++count;
      std::array<Point, 4> p;
      for (std::size_t c = 0; c < 4; ++c) p[c] = lattice.point(n[c]);
      EXPECT_NEAR(std::abs(signed_volume(p[0], p[1], p[2], p[3])), 1.0 / 12, 1e-12);
      const auto [least, most] = dihedral_angles(p);
      EXPECT_NEAR(least, 60, 1e-9);
      EXPECT_NEAR(most, 90, 1e-9);
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b) {
          const std::int64_t edge = lattice.edge_between(n[a], n[b]);
          const std::int64_t lower = edge / BccLattice::directions;
          const int direction = static_cast<int>(edge % BccLattice::directions);
          EXPECT_TRUE(lower == n[a] || lower == n[b]);
          EXPECT_EQ(lattice.next(lower, direction), n[a] + n[b] - lower);
          EXPECT_EQ(lattice.previous(n[a] + n[b] - lower, direction), lower);
          EXPECT_EQ(BccLattice::is_long(direction), a / 2 == b / 2);
        }
    }
  EXPECT_GT(count, 12 * 5 * 5 * 5);
}

/// The corners of what cut_tetrahedron leaves of the tetrahedron p, with the cuts at these fractions.
std::vector<std::array<Point, 4>> cut(const std::array<Point, 4>& p, const std::array<Point, 4>& original,
                                      const std::array<Side, 4>& side, const std::array<bool, 4>& even, bool diagonal,
                                      const double (&along)[4][4]) {
  std::vector<StencilTet> stencil;
  cut_tetrahedron(side, even, diagonal, stencil);
  std::vector<std::array<Point, 4>> result;
  for (const StencilTet& t : stencil) {
    auto& corners = result.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      const auto a = static_cast<std::size_t>(t[c].a), b = static_cast<std::size_t>(t[c].b);
      corners[c] = a == b ? p[a] : between(original[a], original[b], along[a][b]);
    }
  }
  return result;
}

double volume(const std::vector<std::array<Point, 4>>& tets) {
  double sum = 0;
  for (const auto& p : tets) sum += std::abs(signed_volume(p[0], p[1], p[2], p[3]));
  return sum;
}

TEST(Stencil, InsideAndOutsideFillTheTetrahedron) {
  const BccLattice lattice = small_lattice();
  std::uint64_t key = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<std::int64_t, 4> n;
    ASSERT_TRUE(lattice.tetrahedron(lattice.node(false, 3, 3, 3), trial % 12, n));
    std::array<Point, 4> p;
    std::array<Side, 4> side, turned;
    std::array<bool, 4> even;
    for (std::size_t c = 0; c < 4; ++c) {
      p[c] = lattice.point(n[c]);
      even[c] = lattice.is_even(n[c]);
      side[c] = static_cast<Side>(static_cast<int>(3 * random(key)) - 1);
      turned[c] = static_cast<Side>(-static_cast<int>(side[c]));
    }
    double along[4][4];
    for (auto& row : along)
      for (double& a : row) a = 0.2 + 0.6 * random(key);
    if (std::ranges::all_of(side, [](Side s) { return s == Side::on; })) continue;
    // Four cuts need not lie in a plane: then both sides take the same diagonal, which one of them names otherwise.
    double nearest = 1;
    for (const bool here : {false, true})
      for (const bool there : {false, true})
        nearest = std::min(nearest, std::abs(volume(cut(p, p, side, even, here, along)) +
                                             volume(cut(p, p, turned, even, there, along)) - 1.0 / 12));
    EXPECT_LT(nearest, 1e-12) << trial;
  }
}

TEST(Stencil, NeighboursCutTheirCommonFaceTheSameWay) {
  const BccLattice lattice = small_lattice();
  std::uint64_t key = 0;
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Side> side;
    for (std::int64_t node = 0; node < lattice.nodes(); ++node)
      side.push_back(static_cast<Side>(static_cast<int>(3 * random(key)) - 1));
    using Corner = std::pair<std::int64_t, std::int64_t>;
    std::map<std::array<Corner, 3>, int> faces;
    std::array<std::int64_t, 4> n;
    for (std::int64_t corner = 0; corner < lattice.corners(); ++corner)
      for (int k = 0; k < BccLattice::tets_per_cube; ++k) {
        if (!lattice.tetrahedron(corner, k, n)) continue;
        std::array<Side, 4> s;
        std::array<bool, 4> even;
        for (std::size_t c = 0; c < 4; ++c)
          s[c] = side[static_cast<std::size_t>(n[c])], even[c] = lattice.is_even(n[c]);
        std::vector<StencilTet> stencil;
        cut_tetrahedron(s, even, corner % 2 == 0, stencil);
        for (const StencilTet& t : stencil)
          for (std::size_t left = 0; left < 4; ++left) {
            std::array<Corner, 3> face;
            for (std::size_t c = 0, f = 0; c < 4; ++c) {
              if (c == left) continue;
              const std::int64_t a = n[static_cast<std::size_t>(t[c].a)], b = n[static_cast<std::size_t>(t[c].b)];
              face[f++] = {std::min(a, b), std::max(a, b)};
            }
            std::ranges::sort(face);
            ++faces[face];
          }
      }
    // What has a node inside is not on the surface: in the middle of the lattice it has two tetrahedra.
    for (const auto& [face, count] : faces) {
      EXPECT_LE(count, 2);
      bool surface = true, at_border = false;
      for (const auto& [a, b] : face) {
        surface &= a != b || side[static_cast<std::size_t>(a)] == Side::on;
        for (const std::int64_t node : {a, b})
          for (const std::int64_t i : lattice.index(node)) at_border |= i < 1 || i > 5;
      }
      if (!surface && !at_border) {
        EXPECT_EQ(count, 2);
      }
    }
  }
}

/// Moves nodes that are on the surface as far as fill() may, and puts cuts where they may be.
TEST(Stencil, AnglesAreBetween10And165Degrees) {
  const BccLattice lattice = small_lattice();
  constexpr double long_reach = 0.286, short_reach = 0.398;
  std::uint64_t key = 0;
  double least = 180, most = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    std::array<std::int64_t, 4> n;
    ASSERT_TRUE(lattice.tetrahedron(lattice.node(false, 3, 3, 3), trial % 12, n));
    std::array<Point, 4> p, original;
    std::array<Side, 4> side;
    std::array<bool, 4> even, inside;
    std::array<std::int64_t, 4> target{-1, -1, -1, -1};
    bool possible = true;
    for (std::size_t c = 0; c < 4; ++c) {
      p[c] = original[c] = lattice.point(n[c]);
      even[c] = lattice.is_even(n[c]);
      side[c] = static_cast<Side>(static_cast<int>(3 * random(key)) - 1);
      inside[c] = side[c] == Side::on ? random(key) < 0.5 : side[c] == Side::inside;
    }
    for (std::size_t c = 0; c < 4; ++c) {
      if (side[c] != Side::on) continue;
      const int direction = static_cast<int>(14 * random(key));
      target[c] = direction < 7 ? lattice.next(n[c], direction) : lattice.previous(n[c], direction - 7);
      const double reach = BccLattice::is_long(direction % 7) ? long_reach : short_reach;
      p[c] = between(p[c], lattice.point(target[c]), reach * std::min(1.0, 1.6 * random(key)));
      for (std::size_t e = 0; e < 4; ++e) {  // between an inside and an outside there is one cut, for one of them
        if (target[c] == n[e] && (inside[e] == inside[c] || target[e] == n[c])) possible = false;
        if (e < c && target[c] == target[e] && inside[e] != inside[c]) possible = false;
      }
    }
    if (!possible) continue;
    double along[4][4];
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b) {
        const double reach = a / 2 == b / 2 ? long_reach : short_reach;
        along[a][b] = reach + (1 - 2 * reach) * std::clamp(1.6 * random(key) - 0.3, 0.0, 1.0);
      }
    std::pair<double, double> best{0, 180};
    for (const bool diagonal : {false, true}) {
      std::pair<double, double> all{180, 0};
      for (const auto& tet : cut(p, original, side, even, diagonal, along)) {
        const auto [low, high] = dihedral_angles(tet);
        all = {std::min(all.first, low), std::max(all.second, high)};
      }
      if (all.first > best.first) best = all;
    }
    least = std::min(least, best.first);
    most = std::max(most, best.second);
  }
  EXPECT_GE(least, 10);
  EXPECT_LT(least, 13);  // the search gets near to the worst
  EXPECT_LE(most, 165);
}

}  // namespace
}  // namespace pelage

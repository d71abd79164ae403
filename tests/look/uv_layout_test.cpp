#include "look/uv_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace pelage {
namespace {

/// Two triangles over the unit square of uv, from `u`, `v` on and of that side.
Attribute square_uv(double u, double v, double side) {
  Attribute uv{"uv", 2, Domain::vertex, {}};
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    uv.values.push_back(u + side * x);
    uv.values.push_back(v + side * y);
  }
  return uv;
}
const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};

std::vector<UvLayout::Texel> all_texels(const UvLayout& layout, std::size_t tile, std::vector<Index>& hidden) {
  std::vector<UvLayout::Texel> all;
  for (int row = 0; row < layout.size(); row += 5) {  // no multiple of the bands inside
    const auto some = layout.texels(tile, row, std::min(row + 5, layout.size()), hidden);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Each texel of a square once, and around it the gutter, round at the corners.
TEST(UvLayout, TexelsShowTheFaceAroundThem) {
  const UvLayout layout(square, square_uv(0.25, 0.25, 0.5), 256);
  EXPECT_EQ(layout.gutter(), 2);
  std::vector<Index> hidden;
  std::size_t inside = 0, gutter = 0;
  for (const UvLayout::Texel& t : all_texels(layout, 0, hidden)) {
    const MeshPlace p = t.shows->place(t.x + 0.5, t.y + 0.5);
    // u = 1/4 + (v + w) / 2 of the first triangle and 1/4 + v / 2 of the second one.
    const double u = 0.25 + 0.5 * (p.face == 0 ? p.v + p.w : p.v), v = 0.25 + 0.5 * (p.face == 0 ? p.w : p.v + p.w);
    EXPECT_NEAR(u, (t.x + 0.5) / 256, 1e-12);
    EXPECT_NEAR(v, 1 - (t.y + 0.5) / 256, 1e-12);
    ++(t.inside ? inside : gutter);
  }
  EXPECT_EQ(inside, 128u * 128);
  EXPECT_EQ(gutter, 4u * 2 * 128 + 4 * 3);
  EXPECT_TRUE(hidden.empty());
  EXPECT_TRUE(layout.notes().empty());
  EXPECT_FALSE(layout.repeats());
}

/// A square and one a tenth as wide in uv, both three units high and two wide.
TEST(UvLayout, TexelsAreAsLongAsTheyAreOnTheLargestPart) {
  TriangleMesh mesh;
  for (const double x : {0.0, 5.0})
    for (const Point& p : {Point{x, 0, 0}, {x + 2, 0, 0}, {x + 2, 0, 3}, {x, 0, 3}}) mesh.points.push_back(p);
  mesh.triangles = square;
  for (const Triangle& t : square) mesh.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  Attribute uv = square_uv(0, 0, 0.5);
  const Attribute small = square_uv(0.6, 0, 0.05);
  uv.values.insert(uv.values.end(), small.values.begin(), small.values.end());
  EXPECT_DOUBLE_EQ(texel_length(mesh, uv, 100, 0.55), 3 / 50.0);
  EXPECT_DOUBLE_EQ(texel_length(mesh, uv, 100, 0.45), 3 / 5.0);
}

TEST(UvLayout, WholeTilesAreImagesOfTheirOwn) {
  std::vector<Triangle> triangles = square;
  Attribute uv = square_uv(0, 0, 1);
  for (const Triangle& t : square) triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  const Attribute beside = square_uv(2, 1, 0.5);
  uv.values.insert(uv.values.end(), beside.values.begin(), beside.values.end());
  const UvLayout layout(triangles, uv, 64);
  EXPECT_EQ(layout.tiles(), (std::vector<int>{1001, 1013}));
  EXPECT_EQ(layout.tile_of(0), 0u);
  EXPECT_EQ(layout.tile_of(3), 1u);
  std::vector<Index> hidden;
  const auto first = all_texels(layout, 0, hidden), second = all_texels(layout, 1, hidden);
  EXPECT_EQ(first.size(), 64u * 64);
  EXPECT_EQ(std::ranges::count_if(second, [](const auto& t) { return t.inside; }), 32 * 32);
  EXPECT_TRUE(std::ranges::all_of(second, [](const auto& t) { return t.shows->face >= 2; }));
}

/// What lies across the border comes in again on the other side, with a gutter there, too.
TEST(UvLayout, WhatLiesAcrossTheBorderRepeats) {
  const UvLayout layout(square, square_uv(0.75, 0.25, 0.5), 64);
  EXPECT_TRUE(layout.repeats());
  ASSERT_EQ(layout.notes().size(), 1u);
  EXPECT_EQ(layout.notes()[0].kind, UvNote::Kind::outside);
  EXPECT_EQ(layout.notes()[0].count, 2u);
  std::vector<Index> hidden;
  int left = 0, right = 0;
  for (const UvLayout::Texel& t : all_texels(layout, 0, hidden))
    if (t.inside) ++(t.x < 32 ? left : right);
  EXPECT_EQ(left, 16 * 32);
  EXPECT_EQ(right, 16 * 32);
}

TEST(UvLayout, NotesFacesThatLieOverOthersMirroredOrFlat) {
  std::vector<Triangle> triangles = square;  // once as it is, once mirrored, and one without area
  for (const Triangle& t : square) triangles.push_back({t[0], t[2], t[1]});
  triangles.push_back({0, 0, 2});
  const UvLayout layout(triangles, square_uv(0, 0, 1), 32);
  std::map<UvNote::Kind, std::pair<std::size_t, Index>> notes;
  for (const UvNote& n : layout.notes()) notes[n.kind] = {n.count, n.first};
  EXPECT_EQ(notes[UvNote::Kind::mirrored], (std::pair<std::size_t, Index>{2, 2}));
  EXPECT_EQ(notes[UvNote::Kind::degenerate], (std::pair<std::size_t, Index>{1, 4}));
  std::vector<Index> hidden;
  const auto texels = all_texels(layout, 0, hidden);
  EXPECT_TRUE(std::ranges::all_of(texels, [](const auto& t) { return t.shows->face < 2; }));
  std::ranges::sort(hidden);
  hidden.erase(std::ranges::unique(hidden).begin(), hidden.end());
  EXPECT_EQ(hidden, (std::vector<Index>{2, 3}));
}

}  // namespace
}  // namespace pelage

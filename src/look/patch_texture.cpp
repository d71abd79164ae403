#include "look/patch_texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>

#include "look/tessellation.h"
#include "pelage/error.h"
#include "shape/atlas.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// --- layout --------------------------------------------------------------------------------------------

/// Smaller copies of an image halve it; so many texels keep charts apart in the first four of a large one.
int gutter_of(int size) { return std::clamp(size / 128, 2, 16); }

int texels(std::int32_t nodes, double per_cell) { return static_cast<int>(std::lround(per_cell * (nodes - 1))) + 1; }

/// Charts in rows, the highest ones first; nothing where they need more than the square.
bool place_charts(const Atlas& atlas, double per_cell, PatchLayout& layout) {
  layout.charts.clear();
  for (const Atlas::Patch& p : atlas.patches)
    layout.charts.push_back({0, 0, texels(p.grid.count[0], per_cell), texels(p.grid.count[1], per_cell)});
  std::vector<std::size_t> order(layout.charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return layout.charts[i].height; });
  std::int64_t x = 0, y = 0, row = 0;
  for (const std::size_t i : order) {
    PatchLayout::Chart& c = layout.charts[i];
    const std::int64_t width = std::int64_t{c.width} + 2 * layout.gutter, height = c.height + 2 * layout.gutter;
    if (x + width > layout.size) {
      x = 0;
      y += row;
      row = 0;
    }
    if (width > layout.size || y + height > layout.size) return false;
    c.x = static_cast<int>(x) + layout.gutter;
    c.y = static_cast<int>(y) + layout.gutter;
    x += width;
    row = std::max(row, height);
  }
  return true;
}

/// The next power of two with room for a texel for every node.
std::int64_t size_that_does(const Atlas& atlas) {
  constexpr int largest = 1 << 16;
  for (int size = 16; size <= largest; size *= 2) {
    PatchLayout layout{size, gutter_of(size), {}};
    if (place_charts(atlas, 1, layout)) return size;
  }
  return 0;
}

}  // namespace

PatchLayout lay_out(const Atlas& atlas, int size) {
  PatchLayout layout{size, gutter_of(size), {}};
  if (!place_charts(atlas, 1, layout)) {
    const std::int64_t enough = size_that_does(atlas);
    throw Error(Fault::usage, "an image of " + std::to_string(size) + " x " + std::to_string(size) +
                                  " texels has no room for a texel at every node" +
                                  (enough > 0 ? "; " + std::to_string(enough) + " are enough" : ""));
  }
  double fits = 1, too_many = size;
  for (int halvings = 0; halvings < 30; ++halvings) {
    const double middle = (fits + too_many) / 2;
    (place_charts(atlas, middle, layout) ? fits : too_many) = middle;
  }
  place_charts(atlas, fits, layout);
  return layout;
}

Attribute patch_uv(const Atlas& atlas, const PatchLayout& layout) {
  Attribute uv{"uv", 2, Domain::corner, {}};
  for_triangles(atlas, [&](std::size_t patch, const Triangle& triangle) {
    const Grid& grid = atlas.patches[patch].grid;
    const PatchLayout::Chart& c = layout.charts[patch];
    for (const std::int32_t node : triangle) {
      const double right = static_cast<double>(node % grid.count[0]) / (grid.count[0] - 1),
                   up = static_cast<double>(node / grid.count[0]) / (grid.count[1] - 1);
      uv.values.push_back((c.x + 0.5 + right * (c.width - 1)) / layout.size);
      uv.values.push_back(1 - (c.y + 0.5 + (1 - up) * (c.height - 1)) / layout.size);
    }
  });
  return uv;
}

// --- images --------------------------------------------------------------------------------------------

namespace {

/// A place along an axis of a patch: between nodes `before` and `before` + 1.
struct Between {
  std::int32_t before;
  double share;
};

Between between(int texel, int texels, std::int32_t nodes) {
  const double place = static_cast<double>(texel) * (nodes - 1) / (texels - 1);
  const auto before = std::min(static_cast<std::int32_t>(place), nodes - 2);
  return {before, place - before};
}

/// The nodes of a patch and their weights in a row of texels.
struct RowOfTexels {
  std::vector<std::array<std::int32_t, 4>> node;
  std::vector<std::array<double, 4>> weight;

  template <class Get>
  double mean(std::size_t texel, const Get& get) const {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += weight[texel][k] * get(at(node[texel][k]));
    return sum;
  }
  std::vector<double> values(const std::vector<double>& at_nodes) const {
    std::vector<double> result(at_nodes.empty() ? 0 : node.size());
    for (std::size_t t = 0; t < result.size(); ++t) result[t] = mean(t, [&](std::size_t v) { return at_nodes[v]; });
    return result;
  }
  std::vector<Point> points(const std::vector<Point>& at_nodes) const {
    std::vector<Point> result(node.size());
    for (std::size_t t = 0; t < result.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) result[t][k] = mean(t, [&](std::size_t v) { return at_nodes[v][k]; });
    return result;
  }
};

RowOfTexels row_of(const Grid& grid, const PatchLayout::Chart& chart, int y) {
  RowOfTexels row;
  const Between up = between(chart.height - 1 - y, chart.height, grid.count[1]);
  for (int x = 0; x < chart.width; ++x) {
    const Between right = between(x, chart.width, grid.count[0]);
    std::array<std::int32_t, 4> node;
    std::array<double, 4> weight;
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t i = k % 2, j = k / 2;
      node[at(k)] = grid.node(right.before + i, up.before + j, 0);
      weight[at(k)] = (i == 0 ? 1 - right.share : right.share) * (j == 0 ? 1 - up.share : up.share);
    }
    row.node.push_back(node);
    row.weight.push_back(weight);
  }
  return row;
}

/// Seen from the outer side of a patch what is seen from the other side of a surface that has one only.
void turn_to_outside(const Atlas::Patch& patch, CoatSamples& s) {
  const Grid& grid = patch.grid;
  for (std::int32_t j = 0; j < grid.count[1]; ++j)
    for (std::int32_t i = 0; i < grid.count[0]; ++i) {
      const auto along = [&](std::int32_t di, std::int32_t dj) {
        const std::int32_t right = std::min(i + di, grid.count[0] - 1), up = std::min(j + dj, grid.count[1] - 1);
        return difference(grid.point(grid.node(right, up, 0)), grid.point(grid.node(right - di, up - dj, 0)));
      };
      const std::size_t v = at(grid.node(i, j, 0));
      if (dot(cross(along(1, 0), along(0, 1)), s.normal[v]) * (patch.turned ? -1 : 1) >= 0) continue;
      for (double& x : s.normal[v]) x = -x;
      if (!s.curvature.k1.empty())
        std::tie(s.curvature.k1[v], s.curvature.k2[v]) = std::pair{-s.curvature.k2[v], -s.curvature.k1[v]};
    }
}

std::vector<Point> on_patch(const Atlas::Patch& patch, const std::vector<Point>& values) {
  std::vector<Point> result;
  for (const std::int32_t n : patch.node) result.push_back(values[at(n)]);
  return result;
}

CoatSamples on_patch(const Atlas& atlas, const Atlas::Patch& patch, const CoatSamples& nodes) {
  CoatSamples s = without_samples(nodes);
  s.position = on_patch(patch, nodes.position);
  s.normal = on_patch(patch, nodes.normal);
  if (!nodes.curvature.k1.empty())
    s.curvature = {on_patch(patch, nodes.curvature.k1, 1), on_patch(patch, nodes.curvature.k2, 1)};
  for (const std::vector<double>& field : nodes.fields) s.fields.push_back(on_patch(patch, field, 1));
  for (const auto& [name, values] : nodes.attributes) s.attributes[name] = on_patch(patch, values, 1);
  if (atlas.one_sided) turn_to_outside(patch, s);
  return s;
}

CoatSamples in_row(const CoatSamples& nodes, const RowOfTexels& row) {
  CoatSamples s = without_samples(nodes);
  s.position = row.points(nodes.position);
  s.normal = row.points(nodes.normal);
  for (Point& n : s.normal) n = unit(n);
  s.curvature = {row.values(nodes.curvature.k1), row.values(nodes.curvature.k2)};
  for (const std::vector<double>& field : nodes.fields) s.fields.push_back(row.values(field));
  for (const auto& [name, values] : nodes.attributes) s.attributes[name] = row.values(values);
  return s;
}

}  // namespace

std::vector<Image> patch_images(const CoatFields& fields, const Look& look, const PatchLayout& layout) {
  const Atlas& atlas = *as<Atlas>(fields.nodes);
  const Paint resolved = resolve_paint(look, fields.species);
  const CoatSamples nodes = samples_at_nodes(fields, tessellation_request(look, resolved));
  const Palette palette = make_palette(resolved, nodes, fields.uniform);
  std::vector<Image> images;
  for (std::size_t p = 0; p < atlas.patches.size(); ++p) {
    const PatchLayout::Chart& chart = layout.charts[p];
    const CoatSamples patch = on_patch(atlas, atlas.patches[p], nodes);
    Image image{chart.width, chart.height, {}};
    image.rgb.reserve(3 * at(chart.width) * at(chart.height));
    for (int y = 0; y < chart.height; ++y)
      for (const double value : paint(in_row(patch, row_of(atlas.patches[p].grid, chart, y)), palette))
        image.rgb.push_back(static_cast<float>(value));
    images.push_back(std::move(image));
  }
  return images;
}

namespace {

std::array<float, 3> mean_color(const std::vector<Image>& images) {
  std::array<double, 3> sum{};
  double count = 0;
  for (const Image& image : images)
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      sum[i % 3] += image.rgb[i];
      count += i % 3 == 0;
    }
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count), static_cast<float>(sum[2] / count)};
}

}  // namespace

Image joined(const std::vector<Image>& patches, const PatchLayout& layout) {
  assert(patches.size() == layout.charts.size());
  Image image{layout.size, layout.size, std::vector<float>(3 * at(layout.size) * at(layout.size))};
  const std::array<float, 3> between = mean_color(patches);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = between[i % 3];
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const PatchLayout::Chart& c = layout.charts[p];
    for (int y = -layout.gutter; y < c.height + layout.gutter; ++y)
      for (int x = -layout.gutter; x < c.width + layout.gutter; ++x) {
        const int from_x = std::clamp(x, 0, c.width - 1), from_y = std::clamp(y, 0, c.height - 1);
        std::copy_n(&patches[p].rgb[3 * (at(from_y) * at(c.width) + at(from_x))], 3,
                    &image.rgb[3 * (at(c.y + y) * at(layout.size) + at(c.x + x))]);
      }
  }
  return image;
}

}  // namespace pelage

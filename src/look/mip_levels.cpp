#include "look/mip_levels.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/srgb.h"
#include "look/surface_blur.h"
#include "shape/locate.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Red, green and blue at the vertices of a tessellation, in linear light.
std::vector<Vector> light_of(const Tessellation& t, const Palette& palette) {
  const std::vector<double> colors = paint(t.samples, palette);
  std::vector<Vector> light(3, Vector(static_cast<Eigen::Index>(t.samples.size())));
  for (std::size_t i = 0; i < colors.size(); ++i) light[i % 3][static_cast<Eigen::Index>(i / 3)] = colors[i];
  return light;
}

/// Colours on a tessellation, or on one of the coarser ones that it was split from.
class BlurredCoat {
 public:
  BlurredCoat(const CoatSampler& coat, const Palette& palette)
      : coat_(coat),
        triangles_(coat.tessellation().triangles),
        points_(coat.tessellation().samples.position),
        finest_(make_topology(points_.size(), triangles_), points_),
        light_(light_of(coat.tessellation(), palette)),
        surface_(triangles_, points_),
        edge_(mean_edge()),
        mean_(means()) {}

  double edge() const { return edge_; }

  /// Until a texel is wider than a few edges, the mesh becomes coarser: colours that are blurred so far need no other,
  /// and the work of all levels is about that of the first ones.
  void blur(double texel) {
    constexpr double edges = 8;
    if (!differs()) return;
    while (texel > edges * edge_ && triangles_.size() > coat_.triangles().size()) coarsen();
    surface_.blur(light_, texel * texel / 4 - variance_);
    variance_ = texel * texel / 4;
  }

  Pixels image(const UvLayout& layout, std::size_t tile) const {
    const auto size = static_cast<std::size_t>(layout.size());
    Pixels image{layout.size(), layout.size(), 3, std::vector<std::uint8_t>(3 * size * size)};
    for (std::size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = srgb_byte(mean_[i % 3]);
    constexpr std::size_t rows = 16;
    parallel_for(
        size,
        [&](std::size_t begin, std::size_t end) {
          std::vector<Index> hidden;
          for (const UvLayout::Texel& t : layout.texels(tile, static_cast<int>(begin), static_cast<int>(end), hidden))
            for (std::size_t c = 0; c < 3; ++c)
              image.bytes[3 * (static_cast<std::size_t>(t.y) * size + static_cast<std::size_t>(t.x)) + c] =
                  srgb_byte(light_at(t.shows->place(t.x + 0.5, t.y + 0.5), c));
        },
        rows);
    return image;
  }

 private:
  double mean_edge() const {
    double sum = 0;
    for (const Triangle& corners : triangles_)
      for (std::size_t k = 0; k < 3; ++k)
        sum += length(difference(points_[static_cast<std::size_t>(corners[(k + 1) % 3])],
                                 points_[static_cast<std::size_t>(corners[k])]));
    return sum / (3 * static_cast<double>(triangles_.size()));
  }
  std::array<double, 3> means() const {
    return {surface_.mean(light_[0]), surface_.mean(light_[1]), surface_.mean(light_[2])};
  }

  /// Whether a byte shows anything but the mean.
  bool differs() const {
    constexpr double seen = 1.0 / 1024;
    for (std::size_t c = 0; c < 3; ++c)
      if (maximum(light_[c]) > mean_[c] + seen || minimum(light_[c]) < mean_[c] - seen) return true;
    return false;
  }

  /// By the numbering of shape/refine.h; the mean stays.
  void coarsen() {
    std::vector<Triangle> parents(triangles_.size() / 4);
    Index last = 0;
    for (std::size_t f = 0; f < parents.size(); ++f) {
      parents[f] = {triangles_[4 * f][0], triangles_[4 * f + 1][1], triangles_[4 * f + 2][2]};
      last = std::max(last, std::ranges::max(parents[f]));
    }
    triangles_ = std::move(parents);
    points_.resize(static_cast<std::size_t>(last) + 1);
    for (Vector& u : light_) u.conservativeResize(last + 1);
    surface_ = SurfaceBlur(triangles_, points_);
    edge_ = mean_edge();
    ++coarser_;
    const std::array<double, 3> now = means();
    for (std::size_t c = 0; c < 3; ++c) light_[c].array() += mean_[c] - now[c];
  }

  double light_at(const MeshPlace& on_shape, std::size_t channel) const {
    MeshPlace place = coat_.on_tessellation(on_shape, finest_);
    for (int k = 0; k < coarser_; ++k) place = in_parent(place);
    const Triangle& corners = triangles_[static_cast<std::size_t>(place.face)];
    const Vector& u = light_[channel];
    return (1 - place.v - place.w) * u[corners[0]] + place.v * u[corners[1]] + place.w * u[corners[2]];
  }

  const CoatSampler& coat_;
  std::vector<Triangle> triangles_;
  std::vector<Point> points_;
  const SurfaceWalk finest_;
  std::vector<Vector> light_;
  SurfaceBlur surface_;
  double edge_;
  const std::array<double, 3> mean_;
  double variance_ = 0;
  int coarser_ = 0;
};

}  // namespace

std::vector<std::vector<Pixels>> mip_levels(const CoatSampler& coat, const Palette& palette, const TriangleMesh& shape,
                                            const UvLayout& layout) {
  const Attribute& uv = *shape.find("uv");
  const double image = texel_length(shape, uv, 1, 0.5);
  BlurredCoat blurred(coat, palette);
  const double finest = blurred.edge();
  std::vector<std::vector<Pixels>> levels(layout.tiles().size());
  for (int size = layout.size() / 2; size > 0; size /= 2) {
    const UvLayout coarse(shape.triangles, uv, size);
    const double texel = image / size;
    if (texel < finest) {
      BakedCoat baked = bake(coat, palette, coarse, nullptr);
      for (std::size_t tile = 0; tile < levels.size(); ++tile)
        levels[tile].push_back(std::move(baked.tiles[tile].color));
      continue;
    }
    blurred.blur(texel);
    for (std::size_t tile = 0; tile < levels.size(); ++tile) levels[tile].push_back(blurred.image(coarse, tile));
  }
  return levels;
}

}  // namespace pelage

#include "render/smooth_light.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace pelage {

namespace {

/// 1 at 0 and 0 from 1 on.
float bump(float x) {
  const float rest = std::max(0.0F, 1 - x);
  return rest * rest;
}

/// How far two pixels lie on the same smooth surface.
float same_surface(const LightGuide& p, const LightGuide& q, float squared_distance) {
  const float cosine = std::max(0.0F, p.normal.dot(q.normal));
  const float c2 = cosine * cosine, c4 = c2 * c2, c8 = c4 * c4;
  constexpr float steepest = 0.7F;  // rise above the tangent plane
  const float rise = p.normal.dot(q.position - p.position);
  return c8 * c8 * bump(rise * rise / (steepest * steepest * squared_distance));
}

/// How even light is over a distance on the surface and one in the picture, both squared and in pixels. Over `least`
/// pixels it is taken to be even in any case, or there would be noise.
float same_light(float distance, float step, float closeness) {
  constexpr float part = 0.3F, least = 3;
  return bump(std::min(distance * closeness * closeness / (part * part), step / (least * least)));
}

template <class Light>
class Smoother {
 public:
  Smoother(const std::vector<Light>& pixels, const std::vector<LightGuide>& guides, int width, float stretch)
      : pixels_(pixels),
        guides_(guides),
        width_(width),
        height_(static_cast<int>(pixels.size()) / width),
        stretch_(stretch) {}

  /// The same light; few rays do not find what is nearest, but those of the neighbours help.
  Light with_nearest(int x, int y) const {
    Light out = pixels_[index(x, y)];
    with_neighbours(x, y, 1,
                    [&](std::size_t q, float) { out.closeness = std::max(out.closeness, pixels_[q].closeness); });
    return out;
  }

  Light average(int x, int y, int step) const {
    const Light& middle = pixels_[index(x, y)];
    Light sum;
    sum.closeness = middle.closeness;
    with_neighbours(x, y, step, [&](std::size_t q, float weight) {
      const Light& from = pixels_[q];
      for (std::size_t k = 0; k < from.light.size(); ++k) sum.light[k] += weight * from.light[k];
      sum.count += weight * from.count;
    });
    return sum;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// Calls visit(index, weight) for the pixel and its neighbours `step` pixels away that have samples of the same
  /// surface, weighted 1 2 1 in each direction and by how much they have in common.
  template <class Visit>
  void with_neighbours(int x, int y, int step, Visit&& visit) const {
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const int u = x + i * step, v = y + j * step;
        if (u < 0 || u >= width_ || v < 0 || v >= height_ || pixels_[index(u, v)].count <= 0) continue;
        float weight = (i ? 0.25F : 0.5F) * (j ? 0.25F : 0.5F);
        if (i || j) weight *= in_common(index(x, y), index(u, v), step * i, step * j);
        if (weight > 0) visit(index(u, v), weight);
      }
  }

  float in_common(std::size_t p, std::size_t q, int i, int j) const {
    const float closeness = std::max(pixels_[p].closeness, pixels_[q].closeness);
    const auto across = static_cast<float>(i * i), down = static_cast<float>(j * j);
    if (guides_.empty()) return same_light(across + stretch_ * stretch_ * down, across + down, closeness);
    const float distance = (guides_[p].position - guides_[q].position).squaredNorm() + 1e-6F;
    return same_light(distance, across + down, closeness) * same_surface(guides_[p], guides_[q], distance);
  }

  const std::vector<Light>& pixels_;
  const std::vector<LightGuide>& guides_;
  int width_, height_;
  float stretch_;
};

}  // namespace

template <class Light>
void smooth_light(std::vector<Light>& pixels, const std::vector<LightGuide>& guides, int width, float stretch,
                  int levels, const std::function<void(double)>& report) {
  const Smoother<Light> smoother(pixels, guides, width, stretch);
  std::vector<Light> next(pixels.size());
  constexpr std::size_t slice = 1 << 17, portion = 1 << 10;  // pixels between reports, and for a thread at a time
  for (int level = -1; level < levels; ++level) {
    for (std::size_t begin = 0; begin < pixels.size(); begin += slice) {
      parallel_for(
          std::min(slice, pixels.size() - begin),
          [&](std::size_t from, std::size_t to) {
            for (std::size_t p = begin + from; p < begin + to; ++p) {
              const int x = static_cast<int>(p) % width, y = static_cast<int>(p) / width;
              if (pixels[p].count <= 0)
                next[p] = pixels[p];
              else if (level < 0)
                next[p] = smoother.with_nearest(x, y);
              else
                next[p] = smoother.average(x, y, 1 << level);
            }
          },
          portion);
      report((level + 1 + static_cast<double>(begin) / static_cast<double>(pixels.size())) / (levels + 1));
    }
    pixels.swap(next);
  }
}

template void smooth_light(std::vector<CoatLight>&, const std::vector<LightGuide>&, int, float, int,
                           const std::function<void(double)>&);
template void smooth_light(std::vector<FloorLight>&, const std::vector<LightGuide>&, int, float, int,
                           const std::function<void(double)>&);

}  // namespace pelage

#include "render/path_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace pelage {

namespace {

/// How far two places are of one material: from 0 to 1.
float same_material(const PathGuide& p, const PathGuide& q) {
  constexpr float color = 0.6F, finish = 0.4F;  // at which nothing is the same
  const float difference = std::max({(p.color - q.color).cwiseAbs().maxCoeff() / color,
                                     std::abs(p.finish.roughness - q.finish.roughness) / finish,
                                     std::abs(p.finish.metalness - q.finish.metalness) / finish,
                                     std::abs(p.finish.transmission - q.finish.transmission) / finish,
                                     std::abs(p.finish.opacity - q.finish.opacity) / finish});
  const float rest = std::max(0.0F, 1 - difference);
  return rest * rest;
}

class PathSmoother {
 public:
  explicit PathSmoother(const PathGrid& grid) : grid_(grid) {}

  /// Variances of few samples are noise themselves: too small ones are those of the neighbours.
  PathLight with_even_variance(std::size_t p) const {
    PathLight light = grid_.lights[p];
    float sum = 0, weights = 0;
    with_neighbours(p, 1, [&](std::size_t q, float weight) {
      weight *= alike(p, q);
      sum += weight * grid_.lights[q].variance;
      weights += weight;
    });
    light.variance = std::max(light.variance, sum / weights);
    return light;
  }

  PathLight average(std::size_t p, int step) const {
    PathLight light = grid_.lights[p];
    if (invisible(light)) return light;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float variance = 0, weights = 0;
    with_neighbours(p, step, [&](std::size_t q, float weight) {
      weight *= alike(p, q) * by_chance(light, grid_.lights[q]);
      sum += weight * grid_.lights[q].mean;
      variance += weight * weight * grid_.lights[q].variance;
      weights += weight;
    });
    light.mean = sum / weights;
    light.variance = variance / (weights * weights);
    return light;
  }

 private:
  /// Whether nobody sees the noise.
  static bool invisible(const PathLight& light) {
    constexpr float part = 0.004F;
    const float seen = part * (luminance(light.sharp + light.mean) + 0.05F);
    return light.variance < seen * seen;
  }

  /// How far the difference of two means may be chance.
  static float by_chance(const PathLight& a, const PathLight& b) {
    constexpr float deviations = 2.5F;
    const float difference = luminance(a.mean) - luminance(b.mean);
    return std::exp(-difference * difference / (2 * deviations * deviations * (a.variance + b.variance) / 2 + 1e-12F));
  }

  float alike(std::size_t p, std::size_t q) const {
    if (p == q) return 1;
    return same_surface(grid_.guides[p].surface, grid_.guides[q].surface) *
           same_material(grid_.guides[p], grid_.guides[q]);
  }

  /// Calls visit(index, weight) for a pixel and those `step` pixels away that see the object, weighted 1 2 1 in each
  /// direction.
  template <class Visit>
  void with_neighbours(std::size_t p, int step, Visit&& visit) const {
    const int column = static_cast<int>(p) % grid_.columns, row = static_cast<int>(p) / grid_.columns;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const int u = column + i * step, v = row + j * step;
        if (u < 0 || u >= grid_.columns || v < 0 || v >= grid_.rows) continue;
        const std::size_t q =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(grid_.columns) + static_cast<std::size_t>(u);
        if (grid_.guides[q].seen) visit(q, (i ? 0.25F : 0.5F) * (j ? 0.25F : 0.5F));
      }
  }

  const PathGrid& grid_;
};

/// Replaces the light of all pixels that see the object by change(index).
template <class Change>
void replace(PathGrid& grid, Change&& change) {
  std::vector<PathLight> next = grid.lights;
  constexpr std::size_t portion = 1 << 10;  // for a thread at a time
  parallel_for(
      next.size(),
      [&](std::size_t from, std::size_t to) {
        for (std::size_t p = from; p < to; ++p)
          if (grid.guides[p].seen) next[p] = change(p);
      },
      portion);
  grid.lights.swap(next);
}

}  // namespace

float PathSum::variance() const {
  const auto n = static_cast<float>(count_);
  const float mean = luminance(sum_) / n;
  return count_ < 2 ? 0 : std::max(0.0F, squares_ / n - mean * mean) / (n - 1);
}

void smooth_paths(PathGrid& grid, int levels, const std::function<void(double)>& report) {
  if (levels == 0) return;
  const PathSmoother smoother(grid);
  replace(grid, [&](std::size_t p) { return smoother.with_even_variance(p); });
  for (int level = 0; level < levels; ++level) {
    report(static_cast<double>(level) / levels);
    replace(grid, [&](std::size_t p) { return smoother.average(p, 1 << level); });
  }
}

}  // namespace pelage

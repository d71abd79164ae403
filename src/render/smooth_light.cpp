#include "render/smooth_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace pelage {

namespace {

/// Light is even over these parts of the distance to what is near.
constexpr float lamp_part = 0.2F, room_part = 0.25F;
/// Over so many pixels light is taken to be even in any case, or there would be noise.
constexpr float least_reach = 2.5F;

/// 1 at 0 and 0 from 1 on.
float bump(float x) {
  const float rest = std::max(0.0F, 1 - x);
  return rest * rest;
}

/// How even light is over a distance on the surface and one in the picture, both squared and in pixels.
float same_light(float distance, float step, float closeness) {
  return bump(std::min(distance * closeness * closeness, step / (least_reach * least_reach)));
}

/// A mean of lights with weights of their own for lamp and room.
class Mean {
 public:
  void add(const Light& light, float lamp_weight, float room_weight) {
    for (std::size_t k = 0; k < sum_.lamp.size(); ++k) sum_.lamp[k] += lamp_weight * light.lamp[k];
    sum_.room += room_weight * light.room;
    sum_.lamp_samples += lamp_weight;
    sum_.room_samples += room_weight;
  }
  float weight() const { return sum_.room_samples; }
  Light light() {
    sum_.make_mean();
    return sum_;
  }

 private:
  Light sum_;
};

class Smoother {
 public:
  explicit Smoother(const LightGrid& grid) : grid_(grid) {}

  Closeness spread(std::size_t p, int step) const {
    Closeness out = grid_.closeness[p];
    float sum = 0, weights = 0;
    with_neighbours(p, step, [&](std::size_t q, float weight, float same) {
      if (same > 0) out.lamp = std::max(out.lamp, grid_.closeness[q].lamp);
      sum += weight * same * grid_.closeness[q].room;
      weights += weight * same;
    });
    out.room = sum / weights;
    return out;
  }

  Closeness average_closeness(std::size_t p) const {
    Closeness sum;
    float weights = 0;
    with_neighbours(p, 1, [&](std::size_t q, float weight, float same) {
      sum.lamp += weight * same * grid_.closeness[q].lamp;
      sum.room += weight * same * grid_.closeness[q].room;
      weights += weight * same;
    });
    return {sum.lamp / weights, sum.room / weights};
  }

  Light average_light(std::size_t p, int step) const {
    Mean mean;
    with_neighbours(p, step, [&](std::size_t q, float weight, float same) {
      if (same > 0) add(mean, p, q, weight * same);
    });
    return mean.light();
  }

 private:
  int column(std::size_t p) const { return static_cast<int>(p) % grid_.columns; }
  int row(std::size_t p) const { return static_cast<int>(p) / grid_.columns; }

  /// Calls visit(index, weight, share on the same surface) for the place and its neighbours `step` places away that
  /// have light, weighted 1 2 1 in each direction.
  template <class Visit>
  void with_neighbours(std::size_t p, int step, Visit&& visit) const {
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const int u = column(p) + i * step, v = row(p) + j * step;
        if (u < 0 || u >= grid_.columns || v < 0 || v >= grid_.rows) continue;
        const std::size_t q = grid_.index(u, v);
        if (!grid_.lights[q].traced()) continue;
        visit(q, (i ? 0.25F : 0.5F) * (j ? 0.25F : 0.5F),
              p == q || grid_.guides.empty() ? 1 : same_surface(grid_.guides[p], grid_.guides[q]));
      }
  }

  void add(Mean& mean, std::size_t p, std::size_t q, float weight) const {
    const auto across = static_cast<float>((column(q) - column(p)) * grid_.cell),
               down = static_cast<float>((row(q) - row(p)) * grid_.cell);
    const float step = across * across + down * down;
    const float distance = grid_.guides.empty() ? across * across + grid_.stretch * grid_.stretch * down * down
                                                : (grid_.guides[p].position - grid_.guides[q].position).squaredNorm();
    const Closeness &a = grid_.closeness[p], &b = grid_.closeness[q];
    mean.add(grid_.lights[q], weight * same_light(distance, step, std::max(a.lamp, b.lamp) / lamp_part),
             weight * same_light(distance, step, std::max(a.room, b.room) / room_part));
  }

  const LightGrid& grid_;
};

/// Replaces `values`, one for each place of the grid, by change(index) where there is light; report(fraction) now and
/// then.
template <class Value, class Change>
void replace(const LightGrid& grid, std::vector<Value>& values, const std::function<void(double)>& report,
             Change&& change) {
  std::vector<Value> next(values.size());
  constexpr std::size_t slice = 1 << 16, portion = 1 << 10;  // places between reports, and for a thread at a time
  for (std::size_t begin = 0; begin < next.size(); begin += slice) {
    report(static_cast<double>(begin) / static_cast<double>(next.size()));
    parallel_for(
        std::min(slice, next.size() - begin),
        [&](std::size_t from, std::size_t to) {
          for (std::size_t p = begin + from; p < begin + to; ++p)
            if (grid.lights[p].traced()) next[p] = change(p);
        },
        portion);
  }
  values.swap(next);
}

}  // namespace

void Light::make_mean() {
  for (float& sum : lamp) sum /= lamp_samples;
  room /= room_samples;
  closeness.room /= room_samples;
  lamp_samples = room_samples = 1;
}

float same_surface(const LightGuide& p, const LightGuide& q) {
  const float cosine = std::max(0.0F, p.normal.dot(q.normal));
  const float c2 = cosine * cosine, c4 = c2 * c2;
  constexpr float steepest = 0.7F;  // rise above the tangent plane
  constexpr float tiny = 1e-6F;     // lest equal places divide zero by zero
  const Eigen::Vector3f way = q.position - p.position;
  const float rise = p.normal.dot(way);
  return c4 * c4 * bump(rise * rise / (steepest * steepest * (way.squaredNorm() + tiny)));
}

LightGrid::LightGrid(int pixel_columns, int pixel_rows, int cell_size, float pixel_stretch)
    : cell(cell_size),
      columns((pixel_columns + cell - 1) / cell),
      rows((pixel_rows + cell - 1) / cell),
      stretch(pixel_stretch),
      lights(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)),
      closeness(lights.size()),
      guides(stretch > 0 ? 0 : lights.size()) {}

void find_closeness(LightGrid& grid) {
  for (std::size_t p = 0; p < grid.lights.size(); ++p)
    if (const Light& light = grid.lights[p]; light.traced())
      grid.closeness[p] = {light.closeness.lamp, light.closeness.room / light.room_samples};
  const Smoother smoother(grid);
  const auto silent = [](double) {};
  for (const int step : {1, 2})
    replace(grid, grid.closeness, silent, [&](std::size_t p) { return smoother.spread(p, step); });
  replace(grid, grid.closeness, silent, [&](std::size_t p) { return smoother.average_closeness(p); });
}

std::array<std::uint32_t, 2> rays_wanted(const LightGrid& grid, std::size_t place, std::uint32_t rays) {
  // The integral of the bump over a disc is a third of its area.
  const auto places = [&](float reach) {
    constexpr float third = std::numbers::pi_v<float> / 3;
    const auto cell = static_cast<float>(grid.cell);
    const float even = third * reach * reach / std::max(1.0F, grid.stretch);
    return std::max(even, third * least_reach * least_reach) / (cell * cell);
  };
  constexpr float enough = 64;  // times the fewest, over all places of a mean
  const auto wanted = [&](float reach) {
    return rays * std::bit_ceil(static_cast<std::uint32_t>(std::clamp(enough / places(reach), 1.0F, 16.0F)));
  };
  const Closeness& near = grid.closeness[place];
  return {wanted(lamp_part / near.lamp), wanted(room_part / near.room)};
}

void smooth_light(LightGrid& grid, int levels, const std::function<void(double)>& report) {
  const Smoother smoother(grid);
  for (int level = 0; level < levels; ++level)
    replace(
        grid, grid.lights, [&](double fraction) { report((level + fraction) / levels); },
        [&](std::size_t p) { return smoother.average_light(p, 1 << level); });
}

Light light_at(const LightGrid& grid, int x, int y, const LightGuide* guide) {
  const int column = x / grid.cell, row = y / grid.cell;
  const float u = static_cast<float>(x % grid.cell) / static_cast<float>(grid.cell),
              v = static_cast<float>(y % grid.cell) / static_cast<float>(grid.cell);
  Mean mean;
  const auto add_places = [&](int low, int high, const auto& weight_of) {
    for (int j = std::max(low, -row); j <= std::min(high, grid.rows - 1 - row); ++j)
      for (int i = std::max(low, -column); i <= std::min(high, grid.columns - 1 - column); ++i) {
        const std::size_t q = grid.index(column + i, row + j);
        float weight = weight_of(i, j);
        if (weight <= 0 || !grid.lights[q].traced()) continue;
        if (guide) weight *= same_surface(*guide, grid.guides[q]);
        mean.add(grid.lights[q], weight, weight);
      }
  };
  constexpr float enough = 0.1F;  // of the weight where all is one surface
  add_places(0, 1, [&](int i, int j) { return (i ? u : 1 - u) * (j ? v : 1 - v); });
  if (mean.weight() < enough) add_places(-1, 2, [](int, int) { return 1.0F; });
  return mean.weight() < enough ? Light{} : mean.light();
}

}  // namespace pelage

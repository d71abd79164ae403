#pragma once
// Takes the noise off traced light. Light varies slowly over a surface where the coat's pattern does not, so that it is
// traced in few places, averaged over neighbours on the same piece of surface, and multiplied with the sharp pattern
// afterwards: an a-trous filter (Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination
// Filtering", 2010). It reaches as far as the light can be even: the nearer a thing that throws a shadow, the narrower
// the shadow's edge (Mehta et al., "Axis-Aligned Filtering for Interactive Sampled Soft Shadows", 2012), and the light
// of the room varies over the harmonic mean of the distances around (Ward et al., "A Ray Tracing Solution for Diffuse
// Interreflection", 1988).

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pelage {

/// One over distances in pixels.
struct Closeness {
  float lamp = 0;  ///< to the nearest thing before the key lamp
  float room = 0;  ///< to what is all around, the mean
};

/// Light of one place on one surface. While it is traced, sums over samples.
struct Light {
  /// Of the key lamp: with and without shadow, the same of the highlight.
  enum : std::size_t { key, open_key, gloss, open_gloss };
  std::array<float, 4> lamp{};
  Eigen::Vector3f room = Eigen::Vector3f::Zero();  ///< what differs from its light in the open
  float lamp_samples = 0, room_samples = 0;        ///< both 0 where there is no surface
  Closeness closeness;                             ///< lamp: the largest; room: a sum as well

  bool traced() const { return room_samples > 0; }
  /// Means instead of the sums.
  void make_mean();
  /// Visible shares of the lamp, 1 where it lights nothing anyway.
  float visible_key() const { return lamp[open_key] > 0 ? lamp[key] / lamp[open_key] : 1; }
  float visible_gloss() const { return lamp[open_gloss] > 0 ? lamp[gloss] / lamp[open_gloss] : 1; }
};

/// Where a surface lies, in units of a pixel's size there.
struct LightGuide {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// How far two places lie on the same smooth surface: from 0 to 1.
float same_surface(const LightGuide& p, const LightGuide& q);

/// The light of a part of the picture at one place in each square of `cell` x `cell` pixels, row by row. Some have
/// none.
struct LightGrid {
  /// `pixel_stretch`: the pixels of a plane are so many times higher than wide; 0: the guides say where places lie.
  LightGrid(int pixel_columns, int pixel_rows, int cell_size, float pixel_stretch);

  int cell, columns, rows;
  float stretch;
  std::vector<Light> lights;
  std::vector<Closeness> closeness;  ///< found by find_closeness
  std::vector<LightGuide> guides;    ///< empty in a plane

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Of places whose light has been traced with few rays. These do not find what is nearest, but those of neighbours
/// help; and where it jumped from place to place, it would be seen in the light as streaks.
void find_closeness(LightGrid& grid);

/// So many rays of a place leave no noise in its light when it has been smoothed: at least `rays`, the fewest that do
/// where the light is even, at most 16 times as many. For the lamp and for the room.
std::array<std::uint32_t, 2> rays_wanted(const LightGrid& grid, std::size_t place, std::uint32_t rays);

/// Takes means and leaves such. The light of a place spreads `light_reach` pixels far. `report` is called now and then
/// with the fraction done.
void smooth_light(LightGrid& grid, int levels, const std::function<void(double)>& report);

/// In pixels.
constexpr int light_reach(int levels, int cell) { return cell << levels; }

/// The light in pixel (x, y), counted from the first of the grid, of a surface that lies as `guide` says (nullptr in a
/// plane). Not `traced` if none of the places around lies on the same surface.
Light light_at(const LightGrid& grid, int x, int y, const LightGuide* guide);

}  // namespace pelage

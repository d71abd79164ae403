#pragma once
// Takes the noise off traced light. Light varies slowly over a surface where the coat's pattern does not, so that the
// light of few rays per pixel is averaged over neighbours on the same piece of surface, and multiplied with the sharp
// pattern afterwards: an a-trous filter (Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast Global
// Illumination Filtering", 2010). It reaches as far as the light can be even: the nearer a thing that throws a shadow,
// the narrower the shadow's edge (Mehta et al., "Axis-Aligned Filtering for Interactive Sampled Soft Shadows", 2012).

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

namespace pelage {

/// Sums over the light samples of one pixel on one surface.
template <std::size_t N>
struct LightSums {
  std::array<float, N> light{};
  float count = 0;  ///< of samples
  /// One over the distance in pixels of the nearest thing that its rays met.
  float closeness = 0;
};

/// The coat: light of the key lamp with and without shadow, the same of the highlight, and of the room what differs
/// from its light in the open.
struct CoatLight : LightSums<8> {
  enum : std::size_t { key, open_key, gloss, open_gloss, room };  // room: three colours

  /// Visible shares of the lamp, 1 where it lights nothing anyway.
  float visible_key() const { return light[open_key] > 0 ? light[key] / light[open_key] : 1; }
  float visible_gloss() const { return light[open_gloss] > 0 ? light[gloss] / light[open_gloss] : 1; }
  Eigen::Vector3f room_light() const { return Eigen::Map<const Eigen::Vector3f>(light.data() + room) / count; }
};

/// The floor: change of its light by the object, as a share.
struct FloorLight : LightSums<4> {
  Eigen::Vector3f change() const { return Eigen::Map<const Eigen::Vector3f>(light.data()) / count; }
};

/// Where the surface of a pixel lies, in units of a pixel's size there.
struct LightGuide {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// A part of the picture, row by row. Pixels without samples stay without. `guides` say where they lie; if empty, in
/// one plane whose pixels are `stretch` times higher than wide. The light of a pixel spreads `light_reach(levels)`
/// pixels far. `report` is called now and then with the fraction done.
template <class Light>
void smooth_light(std::vector<Light>& pixels, const std::vector<LightGuide>& guides, int width, float stretch,
                  int levels, const std::function<void(double)>& report);

/// In pixels.
constexpr int light_reach(int levels) { return 1 << levels; }

}  // namespace pelage

#pragma once
// A coat as images on the uv of its mesh. At every texel the coat is evaluated on the surface: in its middle and, where
// colours bend or there are normals, at four places around it. Colours of texels are those between which bilinear
// interpolation, in linear light, shows the coat best.

#include <map>

#include "look/coat_sampler.h"
#include "look/uv_layout.h"
#include "pelage/texture_maps.h"

namespace pelage {

/// What a mesh shows at the corners of its triangles: normal maps count from there.
struct ShadingFrames {
  std::vector<Point> normal, tangent;  ///< unit length, three per triangle
  std::vector<char> mirrored;          ///< whether bitangent = -cross(normal, tangent)

  /// Of a mesh that has "uv": its own "normal" or else the means of its triangles.
  explicit ShadingFrames(TriangleMesh mesh);
};

struct BakedTile {
  int number = 1001;
  Pixels color;                       ///< sRGB
  Pixels normal;                      ///< empty without frames
  Pixels emission;                    ///< sRGB of a share of the brightest; empty where the paint has none
  std::map<Channel, Pixels> greys{};  ///< the other channels that the paint has; thickness as a share of the deepest
  std::vector<float> height;          ///< [world units] of the paint, or else the values of the shown species
};

/// What white is in images of channels without an upper bound.
struct ChannelScales {
  double brightest = 1;  ///< emission times colour; at least 1
  double deepest = 1;    ///< thickness [world units]
};

struct BakedCoat {
  std::vector<BakedTile> tiles;  ///< those of the layout
  ChannelScales scales{};
  UvNote hidden{UvNote::Kind::overlapping};
};

/// The images of a tile as those of a material.
TextureMaps maps_of(BakedTile tile, const ChannelScales& scales);

/// `frames`: of the mesh that shows the coat, for a normal map of the height, and where that is not the shape of all
/// that the coat's surface has beyond it; or null. Texels that show nothing have the mean of the others.
BakedCoat bake(const CoatSampler& coat, const Palette& palette, const UvLayout& layout, const ShadingFrames* frames);

}  // namespace pelage

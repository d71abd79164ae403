#pragma once
// Samples of a coat, wherever they lie: at vertices of a mesh, at texels of an image.

#include <optional>
#include <vector>

#include "base/box.h"
#include "discretise/curvature.h"
#include "shape/scalar_attributes.h"

namespace pelage {

/// All arrays have one entry per sample.
struct CoatSamples {
  std::vector<Point> position, normal;
  PrincipalCurvatures curvature;            ///< empty unless a formula reads it
  std::vector<std::vector<double>> fields;  ///< per species, in the order of CoatFields
  VertexAttributes attributes;              ///< of the shape and its textures, as formulas know them
  std::vector<Point> drawn_at;              ///< initial places, of a surface that has moved; otherwise empty
  double length_unit = 1;                   ///< world length of a model length unit
  double wavelength = 1;                    ///< of the finest pattern [world units]
  Point origin{};                           ///< from where random fields count
  Point period{};                           ///< after which smooth ones repeat; 0: never
  std::uint64_t seed = 1;                   ///< of random fields
  std::optional<Box> box = {};              ///< of the shape, where the samples are only a part of it

  std::size_t size() const { return position.size(); }
};

/// What all samples of a coat share, and none of them.
inline CoatSamples without_samples(const CoatSamples& coat) {
  CoatSamples shared;
  shared.length_unit = coat.length_unit;
  shared.wavelength = coat.wavelength;
  shared.origin = coat.origin;
  shared.period = coat.period;
  shared.seed = coat.seed;
  shared.box = coat.box ? coat.box : box_of(coat.position);
  return shared;
}

}  // namespace pelage

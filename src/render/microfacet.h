#pragma once
// How surfaces reflect and refract: the microfacet model of glTF 2.0 (appendix B). Facets are distributed after GGX and
// shadow each other as Smith has it, height-correlated; Fresnel's reflectance is Schlick's. What a single reflection
// loses among the facets comes back as Kulla and Conty found it ("Revisiting Physically Based Shading at Imageworks",
// 2017), and so does what reaches the ground below them: a white surface in even light cannot be seen.
//
// Directions are unit vectors that point away from the surface, in a frame whose z axis is the normal.

#include <Eigen/Core>
#include <array>

#include "render/finish.h"

namespace pelage {

/// The facets of a surface with a roughness from 0 to 1.
class Facets {
 public:
  explicit Facets(float roughness);

  /// Density of the normals of facets; integrates to 1 with the cosine.
  float density(float normal_z) const;
  /// The share of a facet's surroundings that is seen from both sides, over 4 times both cosines.
  float visibility(float view_z, float light_z) const;
  /// The normal of a facet as it is seen from `view` (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT
  /// 2018), for a random point of the unit square.
  Eigen::Vector3f visible_normal(const Eigen::Vector3f& view, const std::array<float, 2>& random) const;
  /// The density, over the sphere, of the directions into which these facets mirror the view.
  float mirrored_density(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  /// The share of the light that a visible facet sends towards `light` and that arrives there.
  float passed(float view_z, float light_z) const;

 private:
  float masking(float z) const;  ///< Smith's Lambda

  float alpha2_;
};

/// An opaque surface.
class Reflection {
 public:
  Reflection(const Eigen::Vector3f& color, const Finish& finish);

  /// Ratio of the radiance towards `view` and the irradiance from `light`; the same for both exchanged.
  Eigen::Vector3f brdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  /// Its part by single facets, and Fresnel's reflectance of one at a cosine.
  Eigen::Vector3f mirrored(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  Eigen::Vector3f fresnel(float cosine) const;
  /// What the rest sends towards `view` of even light.
  Eigen::Vector3f scattered(float view_z) const;

  const Facets& facets() const { return facets_; }

 private:
  Facets facets_;
  Eigen::Vector3f facing_;          ///< reflectance at right angles
  Eigen::Vector3f ground_, among_;  ///< scattered below the facets, and among them
  float roughness_;
};

/// Fresnel's reflectance of glass for unpolarised light that meets it at a cosine; `ratio`: of the index of refraction
/// behind the surface to that before it. 1 where all is reflected.
float glass_reflectance(float cosine, float ratio);

/// Index of refraction of glass and of what coats are made of.
constexpr float glass_index = 1.5F;

}  // namespace pelage

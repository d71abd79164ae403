#pragma once
// Follows light through what mirrors, refracts, glows or lets pass: path tracing (Kajiya 1986), with light of the key
// lamp found both by its own directions and by those of the surface, weighted with the balance heuristic (Veach 1997).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "render/microfacet.h"
#include "render/ray_scene.h"
#include "render/sampler.h"
#include "render/studio.h"

namespace pelage {

/// Random numbers of one path: the same index of Sobol's sequence, a new pair of dimensions for every use. Each round
/// has a sequence of its own.
class PathNumbers {
 public:
  explicit PathNumbers(std::uint32_t index, std::uint32_t round = 0) : index_(index), use_(round * uses_of_round) {}
  std::array<float, 2> next() { return scrambled_sobol(index_, first_use + use_++); }

 private:
  static constexpr std::uint32_t first_use = 16;  // behind those of other purposes
  static constexpr std::uint32_t uses_of_round = 1024;
  std::uint32_t index_, use_;
};

/// All queries may run on several threads at once. Each is one sample.
class Paths {
 public:
  Paths(const RayScene& scene, const Studio& studio) : scene_(scene), studio_(studio) {}
  /// In even light of this radiance instead of the studio's.
  Paths(const RayScene& scene, const Studio& studio, const Eigen::Vector3f& even)
      : scene_(scene), studio_(studio), even_(even) {}

  /// What single facets of an opaque surface mirror against the direction in which it is seen.
  Eigen::Vector3f mirrored(const SurfacePoint& point, const Reflection& surface, const Eigen::Vector3f& direction,
                           PathNumbers& random) const;
  /// What comes through a surface that is not opaque or is glass, of the light that it does not send on itself.
  /// `behind`: what the ray would show if it met nothing.
  Eigen::Vector3f through(const SurfacePoint& point, const Finish& finish, const Eigen::Vector3f& direction,
                          const Eigen::Vector3f& behind, PathNumbers& random) const;

 private:
  /// A ray with what it is known by.
  struct Ray {
    Eigen::Vector3f origin, direction;
    Eigen::Vector3f left = Eigen::Vector3f::Ones();  ///< share of its light that arrives in the end
    /// Of the direction, over the sphere, where lamps were asked for as well; otherwise infinite.
    float density = std::numeric_limits<float>::infinity();
    const Eigen::Vector3f* behind = nullptr;  ///< what it shows where it meets nothing
    bool in_glass = false;                    ///< or was: the few ways that lead to the lamp would be noise
  };

  static bool survives(Ray& ray, PathNumbers& random);
  Eigen::Vector3f arriving(Ray ray, PathNumbers& random) const;
  Eigen::Vector3f outside(const Ray& ray, PathNumbers& random) const;
  /// Of the key lamp, where `density(direction)` is that of other samples.
  template <class Brdf, class Density>
  Eigen::Vector3f from_lamp(const SurfacePoint& point, const Brdf& brdf, const Density& density,
                            PathNumbers& random) const;
  /// Both send the ray on; `mirrors`: whether glass reflects it.
  struct Glass;
  Glass glass_at(const SurfacePoint& point, const Finish& finish, const Ray& ray, PathNumbers& random) const;
  void pass_glass(const SurfacePoint& point, const Glass& glass, bool mirrors, Ray& ray) const;
  Eigen::Vector3f pass_opaque(const SurfacePoint& point, const Reflection& surface, Ray& ray,
                              PathNumbers& random) const;

  const RayScene& scene_;
  const Studio& studio_;
  std::optional<Eigen::Vector3f> even_;
};

}  // namespace pelage

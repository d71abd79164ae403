#include "render/microfacet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/sampler.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Smoother facets would be seen through single directions only; what they mirror looks the same.
constexpr float least_alpha = 1e-3F;

float pow5(float x) { return (x * x) * (x * x) * x; }

/// Reflectance of glass at right angles.
constexpr float glass_facing = (glass_index - 1) * (glass_index - 1) / ((glass_index + 1) * (glass_index + 1));

/// Shares of even light that facets reflect towards a view: of white ones, and of ones that reflect at grazing angles
/// alone, as Schlick's term has it.
struct Albedo {
  float white = 0, grazing = 0;
};

Albedo integrate(float view_z, float roughness) {
  const Facets facets(roughness);
  const Vector3f view(std::sqrt(std::max(0.0F, 1 - view_z * view_z)), 0, view_z);
  constexpr std::uint32_t count = 1024;
  Albedo sum;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vector3f half = facets.visible_normal(view, scrambled_sobol(k, 1));
    const float cosine = view.dot(half), light_z = (2 * cosine * half - view).z();
    if (light_z <= 0) continue;
    const float share = facets.passed(view_z, light_z) / count;
    sum.white += share;
    sum.grazing += share * pow5(1 - cosine);
  }
  return sum;
}

/// Albedos over cosine and roughness, and their means over the hemisphere.
class Albedos {
 public:
  static const Albedos& get() {
    static const Albedos albedos;
    return albedos;
  }

  Albedo at(float view_z, float roughness) const {
    const Place column = place(std::sqrt(std::clamp(view_z, 0.0F, 1.0F))), row = place(roughness);
    return blend(blend(table_[row.index][column.index], table_[row.index][column.index + 1], column.share),
                 blend(table_[row.index + 1][column.index], table_[row.index + 1][column.index + 1], column.share),
                 row.share);
  }
  Albedo mean(float roughness) const {
    const Place row = place(roughness);
    return blend(mean_[row.index], mean_[row.index + 1], row.share);
  }

 private:
  static constexpr int cells = 32;  // even in the square root of the cosine: albedos change fastest near the horizon

  struct Place {
    std::size_t index;
    float share;
  };
  static Place place(float x) {
    const int i = std::clamp(static_cast<int>(x * cells), 0, cells - 1);
    return {static_cast<std::size_t>(i), x * cells - static_cast<float>(i)};
  }
  static Albedo blend(const Albedo& a, const Albedo& b, float t) {
    return {a.white + t * (b.white - a.white), a.grazing + t * (b.grazing - a.grazing)};
  }

  Albedos() {
    for (std::size_t row = 0; row <= cells; ++row) {
      const float roughness = static_cast<float>(row) / cells;
      for (std::size_t column = 0; column <= cells; ++column) {
        const float root = std::max(1e-2F, static_cast<float>(column) / cells);
        table_[row][column] = integrate(root * root, roughness);
      }
      mean_[row] = mean_over(table_[row]);
    }
  }
  /// Integral of 2 z over z, which is root^2, of what is linear in the root, by three points a cell.
  static Albedo mean_over(const std::array<Albedo, cells + 1>& row) {
    Albedo sum;
    for (std::size_t c = 0; c < cells; ++c)
      for (const auto& [share, weight] : {std::pair{0.0F, 1.0F}, {0.5F, 4.0F}, {1.0F, 1.0F}}) {
        const float root = (static_cast<float>(c) + share) / cells;
        const Albedo here = blend(row[c], row[c + 1], share);
        const float w = weight / 6 / cells * 4 * root * root * root;
        sum.white += w * here.white;
        sum.grazing += w * here.grazing;
      }
    return sum;
  }

  std::array<std::array<Albedo, cells + 1>, cells + 1> table_;
  std::array<Albedo, cells + 1> mean_;
};

/// Of light that is reflected more than once among facets, what comes out again in the end, for the reflectance of one
/// at right angles.
float among_facets(float facing, const Albedo& mean) {
  const float reflected = facing + (1 - facing) / 21;  // mean of Schlick's over the hemisphere
  return reflected * reflected * mean.white / (1 - reflected * (1 - mean.white));
}

/// All that facets of glass reflect: at a cosine, or its mean.
float of_glass(const Albedo& albedo, float among) {
  return glass_facing * albedo.white + (1 - glass_facing) * albedo.grazing + among * (1 - albedo.white);
}

}  // namespace

Facets::Facets(float roughness) {
  const float alpha = std::max(least_alpha, roughness * roughness);
  alpha2_ = alpha * alpha;
}

float Facets::masking(float z) const {
  const float z2 = std::max(1e-12F, z * z);
  return (std::sqrt(1 + alpha2_ * std::max(0.0F, 1 - z2) / z2) - 1) / 2;
}

float Facets::density(float normal_z) const {
  // 1 - z^2 alone keeps its digits near the pole.
  const float z2 = normal_z * normal_z, d = alpha2_ * z2 + (1 - normal_z) * (1 + normal_z);
  return normal_z > 0 ? alpha2_ / (pi * d * d) : 0;
}

float Facets::visibility(float view_z, float light_z) const {
  return 1 / ((1 + masking(view_z) + masking(light_z)) * 4 * view_z * light_z);
}

float Facets::passed(float view_z, float light_z) const {
  const float view = 1 + masking(view_z);
  return view / (view + masking(light_z));
}

Vector3f Facets::visible_normal(const Vector3f& view, const std::array<float, 2>& random) const {
  const float alpha = std::sqrt(alpha2_);
  const Vector3f stretched = Vector3f(alpha * view.x(), alpha * view.y(), view.z()).normalized();
  const float across2 = stretched.x() * stretched.x() + stretched.y() * stretched.y();
  const Vector3f first =
      across2 > 0 ? Vector3f(Vector3f(-stretched.y(), stretched.x(), 0) / std::sqrt(across2)) : Vector3f(1, 0, 0);
  const Vector3f second = stretched.cross(first);
  const float radius = std::sqrt(random[0]), angle = 2 * pi * random[1];
  const float s = (1 + stretched.z()) / 2, p = radius * std::cos(angle);
  const float q = (1 - s) * std::sqrt(std::max(0.0F, 1 - p * p)) + s * radius * std::sin(angle);
  const Vector3f n = p * first + q * second + std::sqrt(std::max(0.0F, 1 - p * p - q * q)) * stretched;
  return Vector3f(alpha * n.x(), alpha * n.y(), std::max(1e-6F, n.z())).normalized();
}

float Facets::mirrored_density(const Vector3f& view, const Vector3f& light) const {
  const float normal_z = (view + light).normalized().z();
  return density(normal_z) / ((1 + masking(view.z())) * 4 * view.z());
}

Reflection::Reflection(const Vector3f& color, const Finish& finish)
    : facets_(finish.roughness), roughness_(std::clamp(finish.roughness, 0.0F, 1.0F)) {
  const Albedo mean = Albedos::get().mean(roughness_);
  facing_ = (1 - finish.metalness) * Vector3f::Constant(glass_facing) + finish.metalness * color;
  among_ = facing_.unaryExpr([&](float f) { return among_facets(f, mean); }) / std::max(1e-4F, 1 - mean.white);
  ground_ = (1 - finish.metalness) * color / (1 - of_glass(mean, among_facets(glass_facing, mean)));
}

Vector3f Reflection::fresnel(float cosine) const {
  const float grazing = pow5(1 - std::clamp(cosine, 0.0F, 1.0F));
  return facing_ + grazing * (Vector3f::Ones() - facing_);
}

Vector3f Reflection::mirrored(const Vector3f& view, const Vector3f& light) const {
  const Vector3f half = (view + light).normalized();
  return facets_.density(half.z()) * facets_.visibility(view.z(), light.z()) * fresnel(view.dot(half));
}

Vector3f Reflection::brdf(const Vector3f& view, const Vector3f& light) const {
  if (view.z() <= 0 || light.z() <= 0) return Vector3f::Zero();
  const Albedo from = Albedos::get().at(light.z(), roughness_), to = Albedos::get().at(view.z(), roughness_);
  const float among = among_facets(glass_facing, Albedos::get().mean(roughness_));
  const Vector3f scattered =
      (1 - to.white) * (1 - from.white) * among_ + (1 - of_glass(to, among)) * (1 - of_glass(from, among)) * ground_;
  return mirrored(view, light) + scattered / pi;
}

Vector3f Reflection::scattered(float view_z) const {
  const Albedo to = Albedos::get().at(view_z, roughness_), mean = Albedos::get().mean(roughness_);
  const float among = among_facets(glass_facing, mean);
  return (1 - to.white) * (1 - mean.white) * among_ + (1 - of_glass(to, among)) * (1 - of_glass(mean, among)) * ground_;
}

float glass_reflectance(float cosine, float ratio) {
  const float sine2 = (1 - cosine * cosine) / (ratio * ratio);
  if (sine2 >= 1) return 1;
  const float behind = std::sqrt(1 - sine2);
  const float across = (cosine - ratio * behind) / (cosine + ratio * behind),
              along = (ratio * cosine - behind) / (ratio * cosine + behind);
  return (across * across + along * along) / 2;
}

}  // namespace pelage

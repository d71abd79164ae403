#include "render/gloss.h"

#include <algorithm>

namespace pelage {

namespace {

/// Fresnel reflectance of hair and skin at a cosine (Schlick 1994), index of refraction about 1.5.
float fresnel(float cosine) {
  constexpr float facing = 0.04F;
  const float x = 1 - std::clamp(cosine, 0.0F, 1.0F);
  return facing + (1 - facing) * (x * x) * (x * x) * x;
}

}  // namespace

float highlight(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light) {
  constexpr float alpha = 0.22F;  // a brushed coat: broad and soft
  constexpr float alpha2 = alpha * alpha;
  const Eigen::Vector3f half = (view + light).normalized();
  const float nv = std::max(0.05F, normal.dot(view)), nl = normal.dot(light), nh = normal.dot(half);
  if (nl <= 0) return 0;
  const float d = nh * nh * (alpha2 - 1) + 1;
  constexpr float k = alpha / 2;
  const float visibility = 1 / (4 * (nv * (1 - k) + k) * (nl * (1 - k) + k));
  return alpha2 / (d * d) * visibility * fresnel(view.dot(half)) * nl;
}

float sheen(float cosine) {
  constexpr float roughness_loss = 0.35F;  // fur reflects about a third of what a polished surface would
  return roughness_loss * fresnel(cosine);
}

}  // namespace pelage

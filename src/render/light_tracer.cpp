#include "render/light_tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "render/gloss.h"
#include "render/sampler.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

/// What the random numbers of a sample are used for; each use has its own sequence.
enum Use : std::uint32_t { use_key = 2, use_bounce = 3, use_second_key = 4 };

/// Adds one sample; its square, of the mean over the colours.
float add_change(const Vector3f& change, Light& light) {
  light.room += change;
  light.room_samples += 1;
  return change.squaredNorm() / 3;
}

}  // namespace

LightSamples::LightSamples(const Studio& studio) {
  constexpr std::uint32_t count = 1 << 14;  // stays in the cache; neighbours do not meet it again
  samples_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i)
    samples_.push_back({studio.key_direction(scrambled_sobol(i, use_key)),
                        studio.key_direction(scrambled_sobol(i, use_second_key)),
                        disc_point(scrambled_sobol(i, use_bounce))});
}

const LightSample& LightSamples::operator()(int column, int row, std::uint32_t count, std::uint32_t k) const {
  const std::uint32_t number = z_order(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
  return samples_[(number * count + k) % samples_.size()];
}

float LightTracer::closeness(float distance) const {
  constexpr float least = 1e-6F;  // of the object's size: in a crevice a ray may begin where it ends
  return pixel_size_ / std::max(distance, least);
}

/// What sends light to `origin` from `direction`.
LightTracer::Sender LightTracer::sender_of(const Vector3f& origin, const Vector3f& direction,
                                           const LightSample& sample) const {
  const Vector3f& to_key = sample.to_second_key;
  if (const auto hit = scene_.intersect(origin, direction)) {
    const float cosine = hit->normal.dot(to_key);
    const bool lit = cosine > 0 && !scene_.occluded(hit->lifted, to_key);
    const float glow = scene_.finish(hit->hit).emission;
    return {studio_.bounced(hit->color, lit ? cosine : 0) + glow * hit->color, (hit->position - origin).norm()};
  }
  if (direction.y() >= 0) return {studio_.room(direction)};
  const Vector3f floor = origin - direction * (origin.y() / direction.y());
  const bool lit = !scene_.occluded(floor_point(floor).lifted, to_key);
  return {lit ? studio_.open(direction) : studio_.bounced(studio_.paper(), 0), (floor - origin).norm()};
}

float LightTracer::add_lamp(const SurfacePoint& point, const Vector3f& direction, const LightSample& sample,
                            Light& light) const {
  light.lamp_samples += 1;
  const float cosine = point.normal.dot(sample.to_key);
  if (cosine <= 0) return 0;
  const float gloss = highlight(point.normal, -direction, sample.to_key);
  light.lamp[Light::open_key] += cosine;
  light.lamp[Light::open_gloss] += gloss;
  const float free = scene_.distance(point.lifted, sample.to_key);
  light.closeness.lamp = std::max(light.closeness.lamp, closeness(free));
  if (!std::isinf(free)) return cosine * cosine;
  light.lamp[Light::key] += cosine;
  light.lamp[Light::gloss] += gloss;
  return 0;
}

float LightTracer::add_room(const SurfacePoint& point, const LightSample& sample, Light& light) const {
  const Vector3f outward = hemisphere_direction(point.normal, sample.bounce);
  Vector3f change = -studio_.open(outward);
  if (outward.dot(point.face_normal) > 0) {
    const auto sender = sender_of(point.lifted, outward, sample);
    light.closeness.room += closeness(sender.distance);
    change += sender.radiance;
  }
  return add_change(change, light);
}

float LightTracer::add_floor_room(const SurfacePoint& point, const LightSample& sample, Light& light) const {
  const Vector3f upward = hemisphere_direction(point.normal, sample.bounce);
  const auto sender = sender_of(point.lifted, upward, sample);
  light.closeness.room += closeness(sender.distance);
  const bool open = std::isinf(sender.distance);
  return add_change(open ? Vector3f(0, 0, 0) : Vector3f(sender.radiance - studio_.walls(upward)), light);
}

SurfacePoint floor_point(const Vector3f& place) {
  constexpr float height = 1e-4F;  // of the object's size
  const Vector3f up = Vector3f::UnitY();
  return {{up, up, Vector3f::Zero()}, {place.x(), 0, place.z()}, {place.x(), height, place.z()}};
}

}  // namespace pelage

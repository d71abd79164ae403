#include "render/paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/frame.h"
#include "render/light_tracer.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float lift = 1e-4F;  // of the object's size: at which rays leave a surface

/// What is seen at a grazing angle, or just from behind because normals are interpolated, is seen at this cosine.
constexpr float least_cosine = 1e-2F;

/// A view in the frame of a surface.
Vector3f local_view(const Frame& frame, const Vector3f& direction) {
  Vector3f view = frame.to_local(-direction);
  view.z() = std::max(least_cosine, view.z());
  return view.normalized();
}

Vector3f beyond(const SurfacePoint& point) { return point.position - lift * point.face_normal; }

float balance(float own, float other) { return std::isinf(own) ? 1 : own / (own + other); }

/// Thin glass reflects at both sides, and between them.
float reflectance_of(bool thin, float once) { return thin ? 2 * once / (1 + once) : once; }

float brightest(const Vector3f& v) { return v.maxCoeff(); }

}  // namespace

/// A facet of glass.
struct Paths::Glass {
  Frame frame;
  Vector3f view, half;
  float cosine, ratio, reflectance;
  bool thin, clear;
  Vector3f tint;  ///< on the way to it, or through it
};

template <class Brdf, class Density>
Vector3f Paths::from_lamp(const SurfacePoint& point, const Brdf& brdf, const Density& density,
                          PathNumbers& random) const {
  if (even_) return Vector3f::Zero();
  const Vector3f to_lamp = studio_.key_direction(random.next());
  const Vector3f light = Frame(point.normal).to_local(to_lamp);
  if (light.z() <= 0 || to_lamp.dot(point.face_normal) <= 0) return Vector3f::Zero();
  const float share = balance(studio_.key_density(to_lamp), density(light));
  const Vector3f sent = share * pi * light.z() * studio_.key().cwiseProduct(brdf(light));
  constexpr float worth_a_ray = 1e-3F;
  return brightest(sent) < worth_a_ray || scene_.occluded(point.lifted, to_lamp) ? Vector3f(0, 0, 0) : sent;
}

Vector3f Paths::mirrored(const SurfacePoint& point, const Reflection& surface, const Vector3f& direction,
                         PathNumbers& random) const {
  const Frame frame(point.normal);
  const Vector3f view = local_view(frame, direction);
  const Facets& facets = surface.facets();
  Vector3f sum = from_lamp(
      point, [&](const Vector3f& light) { return surface.mirrored(view, light); },
      [&](const Vector3f& light) { return facets.mirrored_density(view, light); }, random);
  const Vector3f half = facets.visible_normal(view, random.next());
  const float cosine = view.dot(half);
  const Vector3f light = 2 * cosine * half - view;
  Ray ray{point.lifted, frame.to_world(light)};
  if (light.z() <= 0 || ray.direction.dot(point.face_normal) <= 0) return sum;
  ray.left = facets.passed(view.z(), light.z()) * surface.fresnel(cosine);
  ray.density = facets.mirrored_density(view, light);
  return sum + arriving(ray, random);
}

Vector3f Paths::through(const SurfacePoint& point, const Finish& finish, const Vector3f& direction,
                        const Vector3f& behind, PathNumbers& random) const {
  Ray ray{beyond(point), direction};
  ray.behind = &behind;
  const float share = finish.opacity * finish.glass() / (1 - finish.opaque());
  if (random.next()[0] >= share) return arriving(ray, random);
  ray.origin = point.position;
  const Glass glass = glass_at(point, finish, ray, random);
  Ray mirrored = ray;
  pass_glass(point, glass, true, mirrored);
  pass_glass(point, glass, false, ray);
  const Facets facets(finish.roughness);
  mirrored.density = facets.mirrored_density(glass.view, glass.frame.to_local(mirrored.direction));
  const Vector3f lamp = from_lamp(
      point,
      [&](const Vector3f& light) {
        const float cosine = std::max(least_cosine, glass.view.dot((glass.view + light).normalized()));
        const float reflectance = reflectance_of(glass.thin, glass_reflectance(cosine, glass.ratio));
        return Vector3f::Constant(reflectance * facets.mirrored_density(glass.view, light) / light.z());
      },
      [&](const Vector3f& light) { return facets.mirrored_density(glass.view, light); }, random);
  return lamp + glass.reflectance * arriving(mirrored, random) + (1 - glass.reflectance) * arriving(ray, random);
}

/// Where the ray leaves the object for good.
Vector3f Paths::outside(const Ray& ray, PathNumbers& random) const {
  if (ray.behind) return *ray.behind;
  if (even_) return *even_;
  if (ray.direction.y() >= 0) {
    const Vector3f lamp = ray.in_glass ? studio_.wide_lamp(ray.direction) : studio_.lamp(ray.direction);
    return studio_.surroundings(ray.direction) + balance(ray.density, studio_.key_density(ray.direction)) * lamp;
  }
  const Vector3f floor = ray.origin - ray.direction * (ray.origin.y() / ray.direction.y());
  return studio_.seen_floor(!scene_.occluded(floor_point(floor).lifted, studio_.key_direction(random.next())));
}

Paths::Glass Paths::glass_at(const SurfacePoint& point, const Finish& finish, const Ray& ray,
                             PathNumbers& random) const {
  const Frame frame(point.normal);
  const Vector3f view = local_view(frame, ray.direction);
  const Vector3f half = Facets(finish.roughness).visible_normal(view, random.next());
  const float cosine = std::max(least_cosine, view.dot(half));
  const bool thin = finish.thickness <= 0, leaving = !thin && scene_.from_behind(ray.direction, point.hit);
  const float ratio = leaving ? 1 / glass_index : glass_index, once = glass_reflectance(cosine, ratio);
  constexpr float clear = 0.05F;  // roughness below which thin glass shows what is behind it
  Glass glass{frame, view, half, cosine, ratio, once, thin, finish.roughness <= clear, Vector3f::Ones()};
  glass.reflectance = reflectance_of(thin, once);
  if (thin) {
    glass.tint = point.color;
  } else if (leaving) {  // Beer's law: on its thickness the light takes the glass's colour
    const float way = (point.position - ray.origin).norm() / finish.thickness;
    glass.tint = point.color.cwiseMax(1e-3F).array().pow(way);
  }
  return glass;
}

void Paths::pass_glass(const SurfacePoint& point, const Glass& g, bool mirrors, Ray& ray) const {
  Vector3f out = 2 * g.cosine * g.half - g.view;
  if (!mirrors && !g.thin) {
    const float behind = 1 - (1 - g.cosine * g.cosine) / (g.ratio * g.ratio);
    out = g.half * (g.cosine / g.ratio - std::sqrt(std::max(0.0F, behind))) - g.view / g.ratio;
  }
  // What other facets would shadow goes on: nothing is lost.
  out.z() = std::copysign(out.z(), mirrors ? 1.0F : -1.0F);
  ray.origin = mirrors ? point.lifted : beyond(point);
  ray.direction = g.frame.to_world(out).normalized();
  if (!mirrors || !g.thin) ray.left = ray.left.cwiseProduct(g.tint);
  if (mirrors || !g.thin || !g.clear) ray.behind = nullptr;
  ray.density = std::numeric_limits<float>::infinity();
  ray.in_glass |= !mirrors;
}

/// One direction of facets or of the ground below them.
Vector3f Paths::pass_opaque(const SurfacePoint& point, const Reflection& surface, Ray& ray, PathNumbers& random) const {
  const Frame frame(point.normal);
  const Vector3f view = local_view(frame, ray.direction);
  const Facets& facets = surface.facets();
  const float mirror = brightest(surface.fresnel(view.z())), ground = brightest(surface.scattered(view.z()));
  const float mirrors = mirror / (mirror + ground);
  const auto density = [&](const Vector3f& light) {
    return mirrors * facets.mirrored_density(view, light) + (1 - mirrors) * light.z() / pi;
  };
  const Vector3f lamp = from_lamp(
      point, [&](const Vector3f& l) { return surface.brdf(view, l); }, density, random);
  const auto numbers = random.next();
  Vector3f light = hemisphere_direction(Vector3f::UnitZ(), disc_point(numbers));
  if (random.next()[0] < mirrors) {
    const Vector3f half = facets.visible_normal(view, numbers);
    light = 2 * view.dot(half) * half - view;
  }
  const Vector3f sum = ray.left.cwiseProduct(lamp);
  ray.origin = point.lifted;
  ray.direction = frame.to_world(light);
  ray.behind = nullptr;
  ray.in_glass = false;
  ray.density = density(light);
  if (light.z() <= 0 || ray.direction.dot(point.face_normal) <= 0)
    ray.left.setZero();
  else
    ray.left = ray.left.cwiseProduct(light.z() / ray.density * surface.brdf(view, light));
  return sum;
}

/// Dim rays are followed in part, for the others of their kind (Russian roulette).
bool Paths::survives(Ray& ray, PathNumbers& random) {
  constexpr float dim = 0.3F;
  const float chance = brightest(ray.left) / dim;
  if (chance >= 1) return true;
  ray.left /= chance;
  return random.next()[0] < chance;
}

Vector3f Paths::arriving(Ray ray, PathNumbers& random) const {
  constexpr int most_events = 24, most_bounces = 3;
  constexpr float invisible = 1e-3F;
  Vector3f sum = Vector3f::Zero();
  for (int event = 0, bounces = 0; event < most_events && brightest(ray.left) > invisible; ++event) {
    const auto point = scene_.meet(ray.origin, ray.direction);
    if (!point) return sum + ray.left.cwiseProduct(outside(ray, random));
    const Finish finish = scene_.finish(point->hit);
    const auto [solid, glass] = random.next();
    if (solid >= finish.opacity) {
      ray.origin = beyond(*point);
      continue;
    }
    sum += finish.emission * ray.left.cwiseProduct(point->color);
    if (!survives(ray, random)) return sum;
    if (glass < finish.glass()) {
      const Glass g = glass_at(*point, finish, ray, random);
      pass_glass(*point, g, random.next()[0] < g.reflectance, ray);
      continue;
    }
    if (++bounces > most_bounces) return sum;
    sum += pass_opaque(*point, Reflection(point->color, finish), ray, random);
  }
  return sum;
}

}  // namespace pelage

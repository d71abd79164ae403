#include "render/painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "render/gloss.h"
#include "render/sampler.h"

namespace pelage {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

/// What the random numbers of a sample are used for; each use has its own sequence.
enum Use : std::uint32_t { use_pixel = 1, use_key = 2, use_bounce = 3, use_second_key = 4, use_dither = 5 };

constexpr double margin = 0.09;  // of the picture around the object

/// Places on the floor are taken a little above it.
constexpr float above_floor = 1e-4F;

/// Density of a tent of half-width 1 pixel around 0, by inversion.
float tent(float random) { return random < 0.5F ? std::sqrt(2 * random) - 1 : 1 - std::sqrt(2 - 2 * random); }

/// The same places in all pixels: edges come out clean. Each quarter is centred, lest few rays shift the picture.
std::vector<Vector2f> view_offsets(std::uint32_t count) {
  std::vector<Vector2f> offsets;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::array<float, 2> random = scrambled_sobol(k, use_pixel);
    offsets.emplace_back(tent(random[0]), tent(random[1]));
  }
  const std::size_t quarter = std::max(2U, count / 4);
  for (std::size_t begin = 0; begin < offsets.size(); begin += quarter) {
    const std::size_t end = std::min(begin + quarter, offsets.size());
    Vector2f mean = Vector2f::Zero();
    for (std::size_t k = begin; k < end; ++k) mean += offsets[k] / static_cast<float>(end - begin);
    for (std::size_t k = begin; k < end; ++k) offsets[k] -= mean;
  }
  return offsets;
}

/// Noise of half a step of 8-bit sRGB at light grey, or the even backdrop would show bands.
float dither(int x, int y) {
  constexpr float step = 0.01F;  // relative, in linear light
  const std::uint32_t number = z_order(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  return 1 + step * (scrambled_sobol(number, use_dither)[0] - 0.5F);
}

void add_color(float* sums, const Vector3f& color) { Eigen::Map<Vector3f>{sums} += color; }

/// Whether the view rays of a pixel agree so well that more of them show nothing new: inside of the object, away from
/// its edges and those of the pattern.
class Agreement {
 public:
  void add(const Skin& skin, const Vector3f& direction) {
    if (seen_++ == 0) first_ = skin.normal;
    low_ = low_.cwiseMin(skin.color);
    high_ = high_.cwiseMax(skin.color);
    turned_ = std::max(turned_, 1 - skin.normal.dot(first_));
    steepest_ = std::min(steepest_, -skin.normal.dot(direction));
  }
  bool reached(std::uint32_t rays) const {
    constexpr float alike = 0.06F, nearly_parallel = 0.03F, edge_on = 0.3F;
    return seen_ == rays && (high_ - low_).maxCoeff() < alike && turned_ < nearly_parallel && steepest_ > edge_on;
  }

 private:
  std::uint32_t seen_ = 0;
  Vector3f first_, low_ = Vector3f::Constant(1e9F), high_ = Vector3f::Constant(-1e9F);
  float turned_ = 0, steepest_ = 1;
};

}  // namespace

Band::Band(int first_row, int row_count, int columns)
    : first(first_row),
      rows(row_count),
      width(columns),
      shades(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width)),
      coat(shades.size()),
      guides(shades.size()),
      floor(shades.size()) {}

/// What comes together in one pixel.
struct Painter::Tally {
  Shade shade;
  CoatLight coat;
  LightGuide guide;
  FloorLight floor;
  Agreement agreement;
  float floor_squares = 0;

  void finish(std::uint32_t rays, float pixel_size) {
    const float share = 1 / static_cast<float>(rays);
    shade.base *= share;
    shade.coat *= share;
    shade.open *= share;
    shade.gloss *= share;
    shade.floor *= share;
    coat.closeness *= pixel_size;
    floor.closeness *= pixel_size;
    if (coat.count > 0) {
      guide.position /= coat.count * pixel_size;
      guide.normal.normalize();
    }
  }
  void store(Band& band, std::size_t i) const {
    band.shades[i] = shade;
    band.coat[i] = coat;
    band.guides[i] = guide;
    band.floor[i] = floor;
  }
};

Painter::Painter(const RayScene& scene, const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles,
                 const PictureOptions& options, Rays rays)
    : scene_(scene),
      width_(options.width),
      height_(options.height),
      rays_(rays),
      tolerance_(0.005F * static_cast<float>(1 << rays.levels)),
      camera_(frame_points(points, options.azimuth, options.elevation,
                           static_cast<double>(options.width) / options.height, margin)),
      studio_(camera_.back, Eigen::Map<const Eigen::Vector3d>(options.background.data()).cast<float>()),
      offsets_(view_offsets(rays.view)),
      pixel_size_(2 * camera_.tan_x / static_cast<float>(width_) * camera_.position.norm()),
      columns_((options.width + tile - 1) / tile) {
  constexpr std::uint32_t sample_count = 1 << 14;  // stays in the cache; neighbours do not meet it again
  for (std::uint32_t i = 0; i < sample_count; ++i)
    samples_.push_back({studio_.key_direction(scrambled_sobol(i, use_key)),
                        studio_.key_direction(scrambled_sobol(i, use_second_key)),
                        disc_point(scrambled_sobol(i, use_bounce))});
  find_busy(points, triangles);
}

void Painter::find_busy(const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles) {
  std::vector<Vector2f> pixels;
  for (const Vector3f& point : points) {
    const Vector2f p = camera_.project(point);
    pixels.emplace_back(static_cast<float>(width_) * (p.x() + 1) / 2, static_cast<float>(height_) * (1 - p.y()) / 2);
  }
  const int rows = (height_ + tile - 1) / tile;
  busy_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  const auto tile_of = [](float pixel, int tiles) {
    return static_cast<int>(std::clamp(pixel / tile, 0.0F, static_cast<float>(tiles - 1)));
  };
  constexpr float reach = 1.5F;  // of the view rays of a pixel, and rounding
  for (const Triangle& t : triangles) {
    const Vector2f low = pixels[t[0]].cwiseMin(pixels[t[1]]).cwiseMin(pixels[t[2]]).array() - reach;
    const Vector2f high = pixels[t[0]].cwiseMax(pixels[t[1]]).cwiseMax(pixels[t[2]]).array() + reach;
    for (int row = tile_of(low.y(), rows); row <= tile_of(high.y(), rows); ++row)
      for (int column = tile_of(low.x(), columns_); column <= tile_of(high.x(), columns_); ++column)
        busy_[static_cast<std::size_t>(row * columns_ + column)] = 1;
  }
}

Vector2f Painter::place(int x, int y, const Vector2f& offset) const {
  const Vector2f pixel = Vector2f(x, y) + Vector2f::Constant(0.5F) + offset;
  return {2 * pixel.x() / static_cast<float>(width_) - 1, 1 - 2 * pixel.y() / static_cast<float>(height_)};
}

const Painter::LightSample& Painter::light_sample(int x, int y, float count) const {
  const std::uint32_t number = z_order(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  return samples_[(number * std::bit_ceil(rays_.light) + static_cast<std::uint32_t>(count)) % samples_.size()];
}

/// Light that comes to `origin` from `direction`, and if what sends it is nearer than 1 / `closeness`, that.
Vector3f Painter::arriving(const Vector3f& origin, const Vector3f& direction, const LightSample& sample,
                           float& closeness) const {
  const Vector3f& to_key = sample.to_second_key;
  if (const auto hit = scene_.intersect(origin, direction)) {
    closeness = std::max(closeness, 1 / (hit->position - origin).norm());
    const float cosine = hit->normal.dot(to_key);
    return studio_.bounced(hit->color, cosine > 0 && !scene_.occluded(hit->lifted, to_key) ? cosine : 0);
  }
  if (direction.y() >= 0) return studio_.room(direction);
  Vector3f floor = origin - direction * (origin.y() / direction.y());
  closeness = std::max(closeness, 1 / (floor - origin).norm());
  floor.y() = above_floor;
  return scene_.occluded(floor, to_key) ? studio_.bounced(studio_.paper(), 0) : studio_.open(direction);
}

void Painter::light_coat(const SurfacePoint& point, const Vector3f& direction, const LightSample& sample,
                         Tally& tally) const {
  std::array<float, 8>& light = tally.coat.light;
  const float cosine = point.normal.dot(sample.to_key);
  if (cosine > 0) {
    const float gloss = highlight(point.normal, -direction, sample.to_key);
    light[CoatLight::open_key] += cosine;
    light[CoatLight::open_gloss] += gloss;
    const float free = scene_.distance(point.lifted, sample.to_key);
    tally.coat.closeness = std::max(tally.coat.closeness, 1 / free);
    if (std::isinf(free)) {
      light[CoatLight::key] += cosine;
      light[CoatLight::gloss] += gloss;
    }
  }
  const Vector3f outward = hemisphere_direction(point.normal, sample.bounce);
  Vector3f room = -studio_.open(outward);
  if (outward.dot(point.face_normal) > 0) room += arriving(point.lifted, outward, sample, tally.coat.closeness);
  add_color(light.data() + CoatLight::room, room);
  tally.coat.count += 1;
  tally.guide.position += point.position;
  tally.guide.normal += point.normal;
}

/// The highlight as a mean over the key lamp.
float Painter::gloss(const Vector3f& normal, const Vector3f& view) const {
  const auto& lamp = studio_.key_points();
  const float middle = highlight(normal, view, lamp[0].direction);
  constexpr float invisible = 0.002F;
  if (middle < invisible) return middle;
  float sum = lamp[0].weight * middle;
  for (std::size_t k = 1; k < lamp.size(); ++k) sum += lamp[k].weight * highlight(normal, view, lamp[k].direction);
  return sum;
}

Shade Painter::coat_shade(const Skin& skin, const Vector3f& direction) const {
  Shade shade;
  shade.coat = skin.color * studio_.key_cosine(skin.normal);
  shade.gloss = gloss(skin.normal, -direction);
  const float mirrored = sheen(-skin.normal.dot(direction));
  shade.open = (1 - mirrored) * skin.color + Vector3f::Constant(mirrored);
  shade.base = shade.open.cwiseProduct(studio_.open_irradiance(skin.normal));
  return shade;
}

/// How the object changes the floor's light, as a share of it, per colour.
Vector3f Painter::floor_change(const Vector3f& floor, const LightSample& sample, float& closeness) const {
  const Vector3f upward = hemisphere_direction(Vector3f::UnitY(), sample.bounce);
  const Vector3f open_key = sample.to_key.y() * studio_.key(), open_room = studio_.open(upward);
  Vector3f change = arriving(floor, upward, sample, closeness) - open_room;
  const float free = scene_.distance(floor, sample.to_key);
  if (!std::isinf(free)) change -= open_key;
  closeness = std::max(closeness, 1 / free);
  return change.cwiseQuotient(open_key + open_room);
}

/// Where a view ray that misses the object meets the floor, if that is so near that the object can change its light.
bool Painter::reaches_floor(const Vector3f& direction, Vector3f& floor) const {
  constexpr float far_away = 4;  // object sizes: no shadow reaches there
  if (direction.y() >= 0 || camera_.position.y() <= 0) return false;
  floor = camera_.position - direction * (camera_.position.y() / direction.y());
  floor.y() = above_floor;
  return floor.norm() <= far_away;
}

/// Light that changes over a few pixels cannot be smoothed, but that is so in few places.
template <class Light>
bool Painter::wants(const Light& light) const {
  constexpr float near = 24, more = 4;  // pixels, times
  return light.count < static_cast<float>(rays_.light) * (near * pixel_size_ * light.closeness > 1 ? more : 1);
}

/// Light where a view ray of pixel (x, y) meets the floor, if it does.
void Painter::light_floor(int x, int y, const Vector3f& direction, Tally& tally) const {
  Vector3f floor;
  if (!reaches_floor(direction, floor)) return;
  const Vector3f change = floor_change(floor, light_sample(x, y, tally.floor.count), tally.floor.closeness);
  add_color(tally.floor.light.data(), change);
  tally.floor_squares += change.squaredNorm();
  tally.floor.count += 1;
}

/// The backdrop at a place of the picture, as a view ray sees it that misses the object.
void Painter::add_paper(const Vector2f& place, const Vector3f& direction, Shade& shade) const {
  const float brightness = studio_.backdrop(place.x(), place.y());
  shade.base += brightness * studio_.paper();
  Vector3f floor;
  if (reaches_floor(direction, floor)) shade.floor += brightness;
}

void Painter::add_coat(int x, int y, const Vector3f& direction, const Hit& hit, Tally& tally) const {
  const Skin skin = scene_.skin(direction, hit);
  const Shade shade = coat_shade(skin, direction);
  tally.shade.base += shade.base;
  tally.shade.coat += shade.coat;
  tally.shade.open += shade.open;
  tally.shade.gloss += shade.gloss;
  tally.agreement.add(skin, direction);
  if (wants(tally.coat))
    light_coat(scene_.surface_point(skin, hit), direction, light_sample(x, y, tally.coat.count), tally);
}

Painter::Tally Painter::trace_object(int x, int y) const {
  Tally tally;
  const std::uint32_t bundle = std::clamp<std::uint32_t>(rays_.view / 4, 1, RayScene::widest_bundle);
  std::array<Vector3f, RayScene::widest_bundle> directions;
  std::array<Hit, RayScene::widest_bundle> hits;
  std::uint32_t done = 0;
  while (done < rays_.view && !(4 * done >= rays_.view && tally.agreement.reached(done))) {
    const std::uint32_t count = std::min(bundle, rays_.view - done);
    for (std::uint32_t k = 0; k < count; ++k) directions[k] = direction_to(place(x, y, offsets_[done + k]));
    scene_.intersect(camera_.position, {directions.data(), count}, {hits.data(), count});
    for (std::uint32_t k = 0; k < count; ++k)
      if (hits[k].triangle != Hit::nothing) {
        add_coat(x, y, directions[k], hits[k], tally);
      } else {
        add_paper(place(x, y, offsets_[done + k]), directions[k], tally.shade);
        if (wants(tally.floor)) light_floor(x, y, directions[k], tally);
      }
    done += count;
  }
  tally.finish(done, pixel_size_);
  return tally;
}

void Painter::trace(Band& band, int column, int row) const {
  const int left = column * tile, right = std::min(left + tile, width_);
  const int top = std::max(row * tile, band.first), bottom = std::min((row + 1) * tile, band.first + band.rows);
  if (!busy(column, row)) return trace_floor(band, left, top, right, bottom);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) trace_object(x, y).store(band, band.index(x, y));
}

/// Where there is no object to be seen. The first rays of all pixels of the square tell how many it needs.
void Painter::trace_floor(Band& band, int left, int top, int right, int bottom) const {
  std::array<Tally, std::size_t{tile} * tile> tallies;
  const auto light = [&](std::uint32_t begin, std::uint32_t end) {
    double squares = 0;
    for (int y = top, i = 0; y < bottom; ++y)
      for (int x = left; x < right; ++x, ++i) {
        Tally& tally = tallies[static_cast<std::size_t>(i)];
        for (std::uint32_t ray = begin; ray < end; ++ray)
          light_floor(x, y, direction_to(place(x, y, offsets_[ray])), tally);
        squares += tally.floor_squares / 3;
      }
    return squares / ((right - left) * (bottom - top));
  };
  std::uint32_t done = 0, next = (rays_.light + 3) / 4;
  double variance = 1;  // of the mean of a pixel, at most
  for (; done < rays_.light && variance > tolerance_ * tolerance_; next = std::min(2 * done, rays_.light)) {
    variance = light(done, next) / (next * next);
    done = next;
  }
  for (int y = top, i = 0; y < bottom; ++y)
    for (int x = left; x < right; ++x, ++i) {
      Tally& tally = tallies[static_cast<std::size_t>(i)];
      const Vector2f middle = place(x, y, Vector2f::Zero());
      add_paper(middle, direction_to(middle), tally.shade);
      tally.finish(1, pixel_size_);
      tally.store(band, band.index(x, y));
    }
}

Vector3f Painter::color(const Band& band, int x, int y) const {
  const std::size_t i = band.index(x, y);
  const Shade& shade = band.shades[i];
  Vector3f color = shade.base;
  if (const CoatLight& light = band.coat[i]; light.count > 0) {
    color += studio_.key().cwiseProduct(shade.coat * light.visible_key() +
                                        Vector3f::Constant(shade.gloss * light.visible_gloss()));
    color += shade.open.cwiseProduct(light.room_light());
  }
  if (const FloorLight& light = band.floor[i]; light.count > 0)
    color += shade.floor * studio_.paper().cwiseProduct(light.change());
  return color.cwiseMax(0) * dither(x, y);
}

}  // namespace pelage

#include "render/painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "render/gloss.h"
#include "render/sampler.h"

namespace pelage {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

/// What random numbers are used for beside light; each use has its own sequence.
enum Use : std::uint32_t { use_pixel = 1, use_dither = 5 };

/// Paths are followed until the standard error of the pixels of a block, before it is smoothed, is this part of what
/// they show, or of `darkest` where they show less: for so many view rays, with more of them as much less. A twentieth
/// of it where nothing is smoothed.
constexpr float path_noise = 0.4F, usual_rays = 16, darkest = 0.05F;
constexpr std::uint32_t first_paths = 4;  // of a pixel at least; at most as many as view rays

/// Density of a tent of half-width 1 pixel around 0, by inversion.
float tent(float random) { return random < 0.5F ? std::sqrt(2 * random) - 1 : 1 - std::sqrt(2 - 2 * random); }

/// The same places in all pixels: edges come out clean. They are centred, lest few rays shift the picture.
std::vector<Vector2f> view_offsets(std::uint32_t count) {
  std::vector<Vector2f> offsets;
  Vector2f mean = Vector2f::Zero();
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::array<float, 2> random = scrambled_sobol(k, use_pixel);
    offsets.emplace_back(tent(random[0]), tent(random[1]));
    mean += offsets.back() / static_cast<float>(count);
  }
  for (Vector2f& offset : offsets) offset -= mean;
  return offsets;
}

constexpr float nearest = 0.1F;  // a camera inside the object is taken to be so far from what it sees, object sizes

constexpr std::uint32_t dither_side = 64;

/// Noise of half a step of 8-bit sRGB at light grey, or the even backdrop would show bands.
std::vector<float> dither_factors(bool wanted) {
  const float step = wanted ? 0.01F : 0;  // relative, in linear light
  std::vector<float> factors;
  for (std::uint32_t i = 0; i < dither_side * dither_side; ++i) {
    const std::uint32_t number = z_order(i % dither_side, i / dither_side);
    factors.push_back(1 + step * (scrambled_sobol(number, use_dither)[0] - 0.5F));
  }
  return factors;
}

/// Whether something at a pixel is far from the mean of what it is at both sides, so that more rays would show more.
bool bends(const Vector3f& before, const Vector3f& here, const Vector3f& after, float most) {
  return (before - 2 * here + after).cwiseAbs().maxCoeff() > most;
}

bool bends(const Sight& before, const Sight& here, const Sight& after) {
  constexpr float color = 0.2F, normal = 0.1F, position = 0.7F;  // linear light, 1, pixels
  return bends(before.color, here.color, after.color, color) ||
         bends(before.guide.normal, here.guide.normal, after.guide.normal, normal) ||
         bends(before.guide.position, here.guide.position, after.guide.position, position);
}

}  // namespace

/// The pixels of a square that are in the band; right and bottom exclusive.
struct Painter::Square {
  int left, top, right, bottom;
  bool busy;
};

/// Where light is traced for a cell of a grid.
struct Painter::Place {
  int row;  ///< of the whole picture's cells
  int column;
  std::size_t index;
  Vector3f direction;  ///< in which it is seen
  SurfacePoint point;
  bool on_floor;
};

/// Where paths of a pixel begin: the share of it that shows one piece of surface.
struct Painter::Way {
  float share;
  std::vector<std::pair<SurfacePoint, Vector3f>> points;  ///< as rays of these directions see them
  Finish finish;
  Reflection surface;
  Vector3f color, normal, view;  ///< means
  Vector3f behind;               ///< the paper
};

/// A pixel and where its paths begin.
struct Painter::Traced {
  std::size_t index;
  std::uint32_t number;
  std::vector<Way> ways;
};

/// What a pixel shows of one piece of surface.
struct Painter::Fragment {
  Hit hit;  ///< of one ray, of this direction
  Vector3f direction;
  LightGuide guide;
  Vector3f color, normal, view;  ///< sums over the rays; view: their directions
  Finish finish;                 ///< likewise
  float rays = 1;
  std::vector<std::pair<Hit, Vector3f>> others = {};  ///< hits and directions of the other rays
};

struct Painter::View {
  std::vector<Fragment> fragments;  // nearly always one
  float missed = 0;                 // rays

  float rays() const {
    float sum = missed;
    for (const Fragment& f : fragments) sum += f.rays;
    return sum;
  }
  void add(const Hit& hit, const Vector3f& direction, const Vector3f& color, const LightGuide& guide,
           const Finish& finish) {
    constexpr float alike = 0.3F;
    for (Fragment& f : fragments)
      if (same_surface(f.guide, guide) > alike) {
        f.color += color, f.normal += guide.normal, f.view += direction, f.rays += 1;
        f.finish.add(1, finish);
        f.others.emplace_back(hit, direction);
        return;
      }
    fragments.push_back({hit, direction, guide, color, guide.normal, direction, finish});
  }
};

Painter::Painter(const RayScene& scene, const std::vector<Vector3f>& points, const Camera& camera,
                 const std::vector<Triangle>& triangles, const PictureOptions& options, Rays rays)
    : scene_(scene),
      width_(options.width),
      height_(options.height),
      rays_(rays),
      camera_(camera),
      ground_(options.ground),
      studio_(camera_.back, Eigen::Map<const Eigen::Vector3d>(options.background.data()).cast<float>(), options.lamp),
      pixel_size_(2 * camera_.tan_x / static_cast<float>(width_) * std::max(nearest, camera_.position.norm())),
      tracer_(scene, studio_, pixel_size_),
      samples_(studio_),
      paths_(scene, studio_),
      floor_key_(studio_.key() * studio_.key_cosine(Vector3f::UnitY())),
      floor_light_(floor_key_ + studio_.floor_irradiance()),
      offsets_(view_offsets(rays.view)),
      dither_(dither_factors(options.dither)),
      columns_((options.width + tile - 1) / tile) {
  find_busy(points, triangles);
}

void Painter::find_busy(const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles) {
  std::vector<Vector2f> pixels(points.size());
  parallel_for(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector2f p = camera_.project(points[i]);
      pixels[i] = {static_cast<float>(width_) * (p.x() + 1) / 2, static_cast<float>(height_) * (1 - p.y()) / 2};
    }
  });
  const int rows = (height_ + tile - 1) / tile;
  busy_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  parallel_for(triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = triangles[i];
      // Behind the camera, or beside it, where the edges of a large triangle may be anywhere.
      const int behind = pixels[t[0]].hasNaN() + pixels[t[1]].hasNaN() + pixels[t[2]].hasNaN();
      if (behind == 3) continue;
      if (behind > 0)
        mark_busy({0, 0}, {static_cast<float>(width_), static_cast<float>(height_)}, rows);
      else
        mark_busy(pixels[t[0]].cwiseMin(pixels[t[1]]).cwiseMin(pixels[t[2]]),
                  pixels[t[0]].cwiseMax(pixels[t[1]]).cwiseMax(pixels[t[2]]), rows);
    }
  });
}

/// What lies in a rectangle of pixels.
void Painter::mark_busy(const Vector2f& low, const Vector2f& high, int rows) {
  constexpr float reach = 1.5F;  // of the view rays of a pixel, and rounding
  const auto tile_of = [](float pixel, int tiles) {
    return static_cast<int>(std::clamp(pixel / tile, 0.0F, static_cast<float>(tiles - 1)));
  };
  const int right = tile_of(high.x() + reach, columns_), bottom = tile_of(high.y() + reach, rows);
  for (int row = tile_of(low.y() - reach, rows); row <= bottom; ++row)
    for (int column = tile_of(low.x() - reach, columns_); column <= right; ++column)
      std::atomic_ref(busy_[static_cast<std::size_t>(row * columns_ + column)]).store(1, std::memory_order_relaxed);
}

Vector2f Painter::place(int x, int y, const Vector2f& offset) const {
  const Vector2f pixel = Vector2f(x, y) + Vector2f::Constant(0.5F) + offset;
  return {2 * pixel.x() / static_cast<float>(width_) - 1, 1 - 2 * pixel.y() / static_cast<float>(height_)};
}

Vector3f Painter::direction(int x, int y, const Vector2f& offset) const {
  const Vector2f p = place(x, y, offset);
  return camera_.direction(p.x(), p.y());
}

Band Painter::band(int first_row, int rows) const {
  return {first_row,
          rows,
          width_,
          std::vector<Sight>(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_)),
          {width_, rows, rays_.cell, 0},
          {width_, rows, rays_.cell, floor_stretch()},
          scene_.plain() ? PathGrid() : PathGrid(width_, rows)};
}

Painter::Square Painter::square(const Band& band, int column, int row) const {
  return {column * tile, std::max(row * tile, band.first), std::min((column + 1) * tile, width_),
          std::min((row + 1) * tile, band.first + band.rows), busy(column, row)};
}

SurfacePoint Painter::surface_point(const Hit& hit, const Vector3f& direction) const {
  return scene_.surface_point(scene_.skin(direction, hit), hit);
}

LightGuide Painter::guide(const Skin& skin, const Hit& hit) const {
  return {scene_.position(hit) / pixel_size_, skin.normal};
}

void Painter::find_sights(Band& band, const Square& s) const {
  std::array<Vector3f, tile> directions;
  std::array<Hit, tile> hits;
  const auto count = static_cast<std::size_t>(s.right - s.left);
  for (int y = s.top; y < s.bottom; ++y) {
    for (std::size_t i = 0; i < count; ++i) directions[i] = direction(s.left + static_cast<int>(i), y);
    scene_.intersect(camera_.position, {directions.data(), count}, {hits.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      if (hits[i].triangle == Hit::nothing) continue;
      const Skin skin = scene_.skin(directions[i], hits[i]);
      band.sight(s.left + static_cast<int>(i), y) = {hits[i], skin.color, guide(skin, hits[i])};
    }
  }
}

/// The first pixel of each cell that shows the coat, and the first that shows the floor.
void Painter::find_places(const Band& band, const Square& s, std::vector<Place>& coat,
                          std::vector<Place>& floor) const {
  const int cell = rays_.cell;
  const auto find = [&](int left, int top, bool seen) {
    for (int y = top; y < std::min(top + cell, s.bottom); ++y)
      for (int x = left; x < std::min(left + cell, s.right); ++x) {
        const Sight& sight = band.sight(x, y);
        if (sight.seen() != seen) continue;
        const Vector3f view = direction(x, y);
        Place place{y / cell, x / cell, band.coat.index(x / cell, (y - band.first) / cell), view, {}, !seen};
        if (seen)
          place.point = surface_point(sight.hit, view);
        else if (Vector3f position; reaches_floor(view, position))
          place.point = floor_point(position);
        else
          return;
        (seen ? coat : floor).push_back(place);
        return;
      }
  };
  for (int y = s.top; y < s.bottom; y += cell)
    for (int x = s.left; x < s.right; x += cell) {
      if (s.busy) find(x, y, true);
      find(x, y, false);
    }
}

float Painter::add_room(const Place& p, const LightSample& sample, Light& light) const {
  return p.on_floor ? tracer_.add_floor_room(p.point, sample, light) : tracer_.add_room(p.point, sample, light);
}

/// The first rays of all places, at least 64 in a square, tell how many are worth their time.
void Painter::add_first_light(LightGrid& grid, const std::vector<Place>& places) const {
  const float tolerance = 0.0025F * static_cast<float>(1 << rays_.levels);  // of noise before it is smoothed
  const auto cell = static_cast<std::uint32_t>(rays_.cell);
  std::uint32_t done = 0, next = std::clamp(64 * cell * cell / (tile * tile), 1U, rays_.light);
  float squares = 0, variance = 1;  // of the mean of a place, at most
  for (; done < rays_.light && variance > tolerance * tolerance; next = std::min(2 * done, rays_.light)) {
    for (const Place& p : places)
      for (std::uint32_t k = done; k < next; ++k) {
        const LightSample& sample = samples_(p.column, p.row, rays_.light, k);
        squares += tracer_.add_lamp(p.point, p.direction, sample, grid.lights[p.index]);
        squares += add_room(p, sample, grid.lights[p.index]);
      }
    done = next;
    variance = squares / static_cast<float>(places.size() * done * done);
  }
}

void Painter::add_more_light(LightGrid& grid, const std::vector<Place>& places) const {
  for (const Place& p : places) {
    Light& light = grid.lights[p.index];
    const auto done = static_cast<std::uint32_t>(light.room_samples);
    const auto [lamp, room] = rays_wanted(grid, p.index, rays_.light);
    if (lamp > rays_.light)
      for (std::uint32_t k = done; k < lamp; ++k)
        tracer_.add_lamp(p.point, p.direction, samples_(p.column, p.row, lamp, k), light);
    if (room > rays_.light)
      for (std::uint32_t k = done; k < room; ++k) add_room(p, samples_(p.column, p.row, room, k), light);
    light.make_mean();
  }
}

void Painter::look(Band& band, int column, int row) const {
  const Square s = square(band, column, row);
  if (s.busy) find_sights(band, s);
  std::vector<Place> coat, floor;
  find_places(band, s, coat, floor);
  for (const Place& p : coat) band.coat.guides[p.index] = {p.point.position / pixel_size_, p.point.normal};
  add_first_light(band.coat, coat);
  add_first_light(band.floor, floor);
}

void Painter::light_more(Band& band, int column, int row) const {
  std::vector<Place> coat, floor;
  find_places(band, square(band, column, row), coat, floor);
  add_more_light(band.coat, coat);
  add_more_light(band.floor, floor);
}

bool Painter::finish_bends(const Sight& before, const Sight& here, const Sight& after) const {
  if (scene_.plain()) return false;
  Finish bend{0, 0, 0, 0, 0, 0};
  for (const auto& [sight, weight] : {std::pair{&before, 1.0F}, {&here, -2.0F}, {&after, 1.0F}})
    bend.add(weight, scene_.finish(sight->hit));
  constexpr float most = 0.2F;
  return std::max({std::abs(bend.roughness), std::abs(bend.metalness), std::abs(bend.opacity), std::abs(bend.emission),
                   std::abs(bend.transmission)}) > most;
}

/// Whether one ray may not be enough for a pixel: at edges of the object and of its pattern.
bool Painter::is_rough(const Band& band, int x, int y) const {
  if (rays_.view == 1) return false;
  if (rays_.levels == 0) return true;
  const Sight& here = band.sight(x, y);
  for (const auto& [i, j] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
    if (!band.contains(x - i, y - j) || !band.contains(x + i, y + j)) continue;
    const Sight &before = band.sight(x - i, y - j), &after = band.sight(x + i, y + j);
    if (before.seen() != here.seen() || after.seen() != here.seen()) return true;
    if (here.seen() && (bends(before, here, after) || finish_bends(before, here, after))) return true;
  }
  return false;
}

Painter::View Painter::full_view(int x, int y) const {
  View view;
  std::array<Vector3f, RayScene::widest_bundle> directions;
  std::array<Hit, RayScene::widest_bundle> hits;
  for (std::size_t done = 0; done < offsets_.size(); done += directions.size()) {
    const std::size_t count = std::min(directions.size(), offsets_.size() - done);
    for (std::size_t k = 0; k < count; ++k) directions[k] = direction(x, y, offsets_[done + k]);
    scene_.intersect(camera_.position, {directions.data(), count}, {hits.data(), count});
    for (std::size_t k = 0; k < count; ++k) {
      if (hits[k].triangle == Hit::nothing) {
        view.missed += 1;
        continue;
      }
      const Skin skin = scene_.skin(directions[k], hits[k]);
      view.add(hits[k], directions[k], skin.color, guide(skin, hits[k]), scene_.finish(hits[k]));
    }
  }
  return view;
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

/// Of a place that none of a grid's lies near.
Light Painter::own_light(const Place& place) const {
  Light light;
  const std::uint32_t count = 8 * rays_.light;
  for (std::uint32_t k = 0; k < count; ++k) {
    const LightSample& sample = samples_(place.column, place.row, count, k);
    tracer_.add_lamp(place.point, place.direction, sample, light);
    add_room(place, sample, light);
  }
  light.make_mean();
  return light;
}

Light Painter::light_of(const Band& band, const Fragment& f, int x, int y) const {
  const Light light = light_at(band.coat, x, y - band.first, &f.guide);
  return light.traced() ? light : own_light({y, x, 0, f.direction, surface_point(f.hit, f.direction), false});
}

Vector3f Painter::coat_color(const Fragment& f, const Light& light) const {
  const Vector3f color = f.color / f.rays, normal = f.normal.normalized(), view = f.view.normalized();
  const float mirrored = sheen(-normal.dot(view));
  const Vector3f sent_on = (1 - mirrored) * color + Vector3f::Constant(mirrored);
  const Vector3f key = light.visible_key() * studio_.key_cosine(normal) * color +
                       Vector3f::Constant(light.visible_gloss() * gloss(normal, -view));
  return studio_.key().cwiseProduct(key) + sent_on.cwiseProduct(studio_.open_irradiance(normal) + light.room);
}

/// What the surface scatters is a matter of the smoothed light, what it mirrors and lets through one of paths.
Vector3f Painter::sharp_color(const Way& way, const Light& light) const {
  const Vector3f even = light.visible_key() * studio_.key_cosine(way.normal) * studio_.key() +
                        studio_.open_irradiance(way.normal) + light.room;
  return way.finish.opacity * way.finish.emission * way.color +
         way.finish.opaque() * way.surface.scattered(std::max(0.0F, -way.normal.dot(way.view))).cwiseProduct(even);
}

Vector3f Painter::path(const Way& way, std::uint32_t number, PathNumbers& random) const {
  const auto& [point, direction] = way.points[number % way.points.size()];
  const float opaque = way.finish.opaque();
  Vector3f sum = Vector3f::Zero();
  if (opaque > 0) sum += opaque * paths_.mirrored(point, way.surface, direction, random);
  if (opaque < 1) sum += (1 - opaque) * paths_.through(point, way.finish, direction, way.behind, random);
  return sum;
}

std::vector<Painter::Way> Painter::find_ways(const Band& band, const View& view, int x, int y) const {
  std::vector<Way> ways;
  for (const Fragment& f : view.fragments) {
    Finish finish{0, 0, 0, 0, 0, 0};
    finish.add(1 / f.rays, f.finish);
    const Vector3f color = f.color / f.rays;
    std::vector<std::pair<SurfacePoint, Vector3f>> points{{surface_point(f.hit, f.direction), f.direction}};
    for (const auto& [hit, direction] : f.others) points.emplace_back(surface_point(hit, direction), direction);
    ways.push_back({f.rays / view.rays(), std::move(points), finish, Reflection(color, finish), color,
                    f.normal.normalized(), f.view.normalized(),
                    finish.opaque() < 1 ? paper_color(band, x, y) : Vector3f(0, 0, 0)});
  }
  return ways;
}

/// Where paths of a pixel begin; what needs none is found at once.
std::vector<Painter::Way> Painter::begin_paths(Band& band, int x, int y) const {
  const View view = view_of(band, x, y);
  const std::size_t index = band.index(x, y);
  Vector3f& sharp = band.paths.lights[index].sharp;
  if (view.missed > 0) sharp = view.missed / view.rays() * paper_color(band, x, y);
  std::vector<Way> ways = find_ways(band, view, x, y);
  for (std::size_t k = 0; k < ways.size(); ++k)
    sharp += ways[k].share * sharp_color(ways[k], light_of(band, view.fragments[k], x, y));
  if (const Sight& sight = band.sights[index]; sight.seen())
    band.paths.guides[index] = {sight.guide, sight.color, scene_.finish(sight.hit), true};
  return ways;
}

/// More paths of one pixel; returns the square of the noise, as a share of what is seen.
float Painter::follow(const Traced& pixel, std::uint32_t count, std::uint32_t round, PathSum& sum,
                      PathLight& light) const {
  for (std::uint32_t k = 0; k < count; ++k) {
    PathNumbers random(pixel.number * count + k, round);
    Vector3f sample = Vector3f::Zero();
    for (const Way& way : pixel.ways) sample += way.share * path(way, sum.count(), random);
    sum.add(sample);
  }
  light.mean = sum.mean(), light.variance = sum.variance();
  const float seen = luminance(light.sharp + light.mean) + darkest;
  return light.variance / (seen * seen);
}

/// The pixels of a small block decide together how many paths they need: that is surer than each by its own.
void Painter::trace_block(Band& band, int left, int top, int right, int bottom) const {
  std::vector<Traced> pixels;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      if (std::vector<Way> ways = begin_paths(band, x, y); !ways.empty())
        pixels.push_back(
            {band.index(x, y), z_order(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), std::move(ways)});
  if (pixels.empty()) return;
  const float wanted = rays_.levels > 0 ? path_noise : path_noise / 20;
  const float fewer = usual_rays / static_cast<float>(rays_.view),
              tolerance = wanted * wanted * std::min(fewer, fewer * fewer);
  std::vector<PathSum> sums(pixels.size());
  std::uint32_t done = 0;
  for (std::uint32_t round = 0, next = std::min(first_paths, rays_.view); done < rays_.view; ++round, next = done) {
    float noise = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      noise += follow(pixels[i], next, round, sums[i], band.paths.lights[pixels[i].index]);
    done += next;
    if (noise < tolerance * static_cast<float>(pixels.size())) return;
  }
}

void Painter::trace(Band& band, int column, int row) const {
  constexpr int block = 4;
  const Square s = square(band, column, row);
  if (!s.busy || scene_.plain()) return;
  for (int y = s.top; y < s.bottom; y += block)
    for (int x = s.left; x < s.right; x += block)
      trace_block(band, x, y, std::min(x + block, s.right), std::min(y + block, s.bottom));
}

Vector3f Painter::paper_color(const Band& band, int x, int y) const {
  const Vector2f middle = place(x, y, Vector2f::Zero());
  const Vector3f paper = studio_.backdrop(middle.x(), middle.y()) * studio_.paper(), view = direction(x, y);
  Vector3f floor;
  if (!reaches_floor(view, floor)) return paper;
  Light light = light_at(band.floor, x, y - band.first, nullptr);
  if (!light.traced()) light = own_light({y, x, 0, view, floor_point(floor), true});
  const Vector3f change = light.room - (1 - light.visible_key()) * floor_key_;
  return paper.cwiseProduct(Vector3f::Ones() + change.cwiseQuotient(floor_light_));
}

/// Where a view ray that misses the object meets the floor, if that is so near that the object can change its light.
bool Painter::reaches_floor(const Vector3f& direction, Vector3f& floor) const {
  constexpr float far_away = 4;  // object sizes: no shadow reaches there
  if (!ground_ || direction.y() >= 0 || camera_.position.y() <= 0) return false;
  floor = camera_.position - direction * (camera_.position.y() / direction.y());
  return floor.norm() <= far_away;
}

/// As the mean of many rays would be where it bends little: the rays' tent has the variance 1/6 in each direction.
Vector3f Painter::blurred_coat(const Band& band, int x, int y) const {
  const Vector3f& here = band.sight(x, y).color;
  Vector3f bend = Vector3f::Zero();
  for (const auto& [i, j] : {std::pair{1, 0}, {0, 1}})
    if (band.contains(x - i, y - j) && band.contains(x + i, y + j))
      bend += band.sight(x - i, y - j).color - 2 * here + band.sight(x + i, y + j).color;
  return (here + bend / 12).cwiseMax(0);
}

Painter::View Painter::view_of(const Band& band, int x, int y) const {
  if (busy(x / tile, y / tile) && is_rough(band, x, y)) return full_view(x, y);
  const Sight& sight = band.sight(x, y);
  if (!sight.seen()) return {{}, 1};
  const Vector3f view = direction(x, y);
  return {
      {{sight.hit, view, sight.guide, blurred_coat(band, x, y), sight.guide.normal, view, scene_.finish(sight.hit)}}};
}

Vector3f Painter::plain_color(const Band& band, int x, int y) const {
  const View view = view_of(band, x, y);
  Vector3f sum = Vector3f::Zero();
  for (const Fragment& f : view.fragments) sum += f.rays * coat_color(f, light_of(band, f, x, y));
  if (view.missed > 0) sum += view.missed * paper_color(band, x, y);
  return sum / view.rays();
}

Vector3f Painter::color(const Band& band, int x, int y) const {
  Vector3f color;
  if (scene_.plain() || !busy(x / tile, y / tile)) {
    color = plain_color(band, x, y);
  } else {
    const PathLight& light = band.paths.lights[band.index(x, y)];
    color = light.sharp + light.mean;
  }
  const auto column = static_cast<std::uint32_t>(x) % dither_side, row = static_cast<std::uint32_t>(y) % dither_side;
  return color.cwiseMax(0) * dither_[row * dither_side + column];
}

}  // namespace pelage

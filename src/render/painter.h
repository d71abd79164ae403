#pragma once
// Follows light through a picture. What is sharp and free of noise (where the coat is seen, its colour, light in the
// open) is kept apart from what needs many rays (shadows, light between object and floor), which is traced in fewer
// places and smoothed.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelage/render.h"
#include "render/camera.h"
#include "render/light_tracer.h"
#include "render/path_light.h"
#include "render/paths.h"
#include "render/ray_scene.h"
#include "render/smooth_light.h"
#include "render/studio.h"

namespace pelage {

/// What the ray through the middle of a pixel meets.
struct Sight {
  Hit hit;
  Eigen::Vector3f color;
  LightGuide guide;

  bool seen() const { return hit.triangle != Hit::nothing; }
};

/// Some rows of the picture.
struct Band {
  int first, rows, width;
  std::vector<Sight> sights;
  LightGrid coat, floor;
  PathGrid paths;  ///< empty where the object is plain

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  const Sight& sight(int x, int y) const { return sights[index(x, y)]; }
  Sight& sight(int x, int y) { return const_cast<Sight&>(static_cast<const Band&>(*this).sight(x, y)); }
  bool contains(int x, int y) const { return x >= 0 && x < width && y >= first && y < first + rows; }
};

/// What a picture is made of.
struct Rays {
  std::uint32_t view;   ///< from the camera per pixel where it shows an edge
  std::uint32_t light;  ///< to the lamp and into the room per place
  int cell;             ///< of LightGrid
  int levels;           ///< of smooth_light; 0: every pixel has all of its rays
};

/// A band is painted in steps, each of which needs the whole one before; after `look` closeness is found, before
/// `trace` light is smoothed, and before `color` what paths have found. All queries may run on several threads at once,
/// for squares of their own.
class Painter {
 public:
  /// The object of `scene` has the corners `points`; the scene must outlive the painter.
  Painter(const RayScene& scene, const std::vector<Eigen::Vector3f>& points, const Camera& camera,
          const std::vector<Triangle>& triangles, const PictureOptions& options, Rays rays);

  /// Pictures are traced in squares of so many pixels.
  static constexpr int tile = 16;
  /// Whether the object may be seen in a square, which then takes longer.
  bool busy(int column, int row) const { return busy_[static_cast<std::size_t>(row * columns_ + column)] != 0; }
  Band band(int first_row, int rows) const;
  /// What is seen in the square, and its first light.
  void look(Band& band, int column, int row) const;
  /// More light where things are near.
  void light_more(Band& band, int column, int row) const;
  /// Follows paths, until their noise is small beside the light of the pixels.
  void trace(Band& band, int column, int row) const;
  Eigen::Vector3f color(const Band& band, int x, int y) const;

 private:
  struct Way;
  struct Traced;
  struct Place;
  struct Fragment;
  struct View;
  struct Square;

  void find_busy(const std::vector<Eigen::Vector3f>& points, const std::vector<Triangle>& triangles);
  void mark_busy(const Eigen::Vector2f& low, const Eigen::Vector2f& high, int rows);
  Square square(const Band& band, int column, int row) const;
  void find_sights(Band& band, const Square& square) const;
  void find_places(const Band& band, const Square& square, std::vector<Place>& coat, std::vector<Place>& floor) const;
  float add_room(const Place& place, const LightSample& sample, Light& light) const;
  void add_first_light(LightGrid& grid, const std::vector<Place>& places) const;
  void add_more_light(LightGrid& grid, const std::vector<Place>& places) const;

  bool is_rough(const Band& band, int x, int y) const;
  View full_view(int x, int y) const;
  View view_of(const Band& band, int x, int y) const;
  Eigen::Vector3f blurred_coat(const Band& band, int x, int y) const;
  Eigen::Vector3f plain_color(const Band& band, int x, int y) const;
  Light own_light(const Place& place) const;
  Light light_of(const Band& band, const Fragment& fragment, int x, int y) const;
  Eigen::Vector3f coat_color(const Fragment& fragment, const Light& light) const;
  Eigen::Vector3f sharp_color(const Way& way, const Light& light) const;
  Eigen::Vector3f path(const Way& way, std::uint32_t number, PathNumbers& random) const;
  std::vector<Way> find_ways(const Band& band, const View& view, int x, int y) const;
  std::vector<Way> begin_paths(Band& band, int x, int y) const;
  float follow(const Traced& pixel, std::uint32_t count, std::uint32_t round, PathSum& sum, PathLight& light) const;
  void trace_block(Band& band, int left, int top, int right, int bottom) const;
  bool finish_bends(const Sight& before, const Sight& here, const Sight& after) const;
  Eigen::Vector3f paper_color(const Band& band, int x, int y) const;
  float gloss(const Eigen::Vector3f& normal, const Eigen::Vector3f& view) const;
  bool reaches_floor(const Eigen::Vector3f& direction, Eigen::Vector3f& place) const;
  /// How many times higher than wide a pixel's image on the floor is, around the object.
  float floor_stretch() const { return 1 / std::max(0.1F, std::abs(camera_.back.y())); }
  SurfacePoint surface_point(const Hit& hit, const Eigen::Vector3f& direction) const;
  LightGuide guide(const Skin& skin, const Hit& hit) const;
  /// Of a point of the picture, `offset` pixels from the middle of pixel (x, y), both coordinates in [-1, 1].
  Eigen::Vector2f place(int x, int y, const Eigen::Vector2f& offset) const;
  Eigen::Vector3f direction(int x, int y, const Eigen::Vector2f& offset = Eigen::Vector2f::Zero()) const;

  const RayScene& scene_;
  int width_, height_;
  Rays rays_;
  Camera camera_;
  bool ground_;
  Studio studio_;
  float pixel_size_;  ///< at the object
  LightTracer tracer_;
  LightSamples samples_;
  Paths paths_;
  Eigen::Vector3f floor_key_, floor_light_;  ///< in the open: of the key lamp, and in all
  std::vector<Eigen::Vector2f> offsets_;     ///< of the view rays from the middle of a pixel, in pixels
  std::vector<float> dither_;
  int columns_;
  std::vector<char> busy_;
};

}  // namespace pelage

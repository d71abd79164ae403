#pragma once
// Follows light through a picture. What is sharp and free of noise (where the coat is seen, its colour, light in the
// open) is kept apart from what needs many rays (shadows, light between object and floor), which can then be smoothed.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelage/render.h"
#include "render/camera.h"
#include "render/ray_scene.h"
#include "render/smooth_light.h"
#include "render/studio.h"

namespace pelage {

/// Of one pixel what has no noise. Its colour is
///   base + key (coat * visible_key + gloss * visible_gloss) + open * room_light + paper * floor * change.
struct Shade {
  Eigen::Vector3f base = Eigen::Vector3f::Zero();  ///< without key lamp and shadows
  Eigen::Vector3f coat = Eigen::Vector3f::Zero();  ///< colour times cosine of the key lamp
  Eigen::Vector3f open = Eigen::Vector3f::Zero();  ///< share of the room's light that is sent on
  float gloss = 0;
  float floor = 0;  ///< brightness of the floor that is seen
};

/// Some rows of the picture.
struct Band {
  Band(int first_row, int rows, int width);

  int first, rows, width;
  std::vector<Shade> shades;
  std::vector<CoatLight> coat;
  std::vector<LightGuide> guides;  ///< of `coat`
  std::vector<FloorLight> floor;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// What a picture is made of.
struct Rays {
  std::uint32_t view;   ///< per pixel from the camera
  std::uint32_t light;  ///< so many of these go on to the lamp and into the room
  int levels;           ///< of smooth_light
};

/// All queries may run on several threads at once.
class Painter {
 public:
  /// The object of `scene` has the corners `points`; both must outlive the painter.
  Painter(const RayScene& scene, const std::vector<Eigen::Vector3f>& points, const std::vector<Triangle>& triangles,
          const PictureOptions& options, Rays rays);

  /// Pictures are traced in squares of so many pixels.
  static constexpr int tile = 16;
  /// Whether the object may be seen in a square, which then takes longer.
  bool busy(int column, int row) const { return busy_[static_cast<std::size_t>(row * columns_ + column)] != 0; }
  /// What lies in the square and in the band.
  void trace(Band& band, int column, int row) const;
  /// How many times higher than wide a pixel's image on the floor is, around the object.
  float floor_stretch() const { return 1 / std::max(0.1F, std::abs(camera_.back.y())); }
  Eigen::Vector3f color(const Band& band, int x, int y) const;

 private:
  struct LightSample {
    Eigen::Vector3f to_key, to_second_key;
    Eigen::Vector2f bounce;  ///< in the unit disc
  };
  struct Tally;

  void find_busy(const std::vector<Eigen::Vector3f>& points, const std::vector<Triangle>& triangles);
  void trace_floor(Band& band, int left, int top, int right, int bottom) const;
  Tally trace_object(int x, int y) const;
  void add_coat(int x, int y, const Eigen::Vector3f& direction, const Hit& hit, Tally& tally) const;
  void add_paper(const Eigen::Vector2f& place, const Eigen::Vector3f& direction, Shade& shade) const;
  float gloss(const Eigen::Vector3f& normal, const Eigen::Vector3f& view) const;
  Shade coat_shade(const Skin& skin, const Eigen::Vector3f& direction) const;
  void light_coat(const SurfacePoint& point, const Eigen::Vector3f& direction, const LightSample& sample,
                  Tally& tally) const;
  void light_floor(int x, int y, const Eigen::Vector3f& direction, Tally& tally) const;
  bool reaches_floor(const Eigen::Vector3f& direction, Eigen::Vector3f& place) const;
  Eigen::Vector3f floor_change(const Eigen::Vector3f& place, const LightSample& sample, float& closeness) const;
  Eigen::Vector3f arriving(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, const LightSample& sample,
                           float& closeness) const;
  template <class Light>
  bool wants(const Light& light) const;
  /// Of a point of the picture, `offset` pixels from the middle of pixel (x, y), both coordinates in [-1, 1].
  Eigen::Vector2f place(int x, int y, const Eigen::Vector2f& offset) const;
  Eigen::Vector3f direction_to(const Eigen::Vector2f& place) const { return camera_.direction(place.x(), place.y()); }
  const LightSample& light_sample(int x, int y, float count) const;  ///< after `count` others in this pixel

  const RayScene& scene_;
  int width_, height_;
  Rays rays_;
  float tolerance_;  ///< of noise in the light of the floor, before it is smoothed
  Camera camera_;
  Studio studio_;
  std::vector<Eigen::Vector2f> offsets_;  ///< of the view rays from the middle of a pixel, in pixels
  std::vector<LightSample> samples_;
  float pixel_size_;  ///< at the object
  int columns_;
  std::vector<char> busy_;
};

}  // namespace pelage

#pragma once
// What paths bring to the pixels of a picture: means of few samples whose noise is known. They are smoothed as far as
// that noise reaches: an a-trous filter that takes for noise what it may be and for the picture what it cannot be
// (Schied et al., "Spatiotemporal Variance-Guided Filtering", 2017).

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/finish.h"
#include "render/smooth_light.h"

namespace pelage {

/// Brightness of linear light for the eye (Rec. 709).
inline float luminance(const Eigen::Vector3f& c) { return 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z(); }

/// Light of one pixel.
struct PathLight {
  Eigen::Vector3f sharp = Eigen::Vector3f::Zero();  ///< what is known without paths
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();   ///< of the paths
  float variance = 0;                               ///< of the mean's luminance
};

/// Samples of one pixel.
class PathSum {
 public:
  void add(const Eigen::Vector3f& sample) {
    const float brightness = luminance(sample);
    sum_ += sample;
    squares_ += brightness * brightness;
    ++count_;
  }
  std::uint32_t count() const { return count_; }
  Eigen::Vector3f mean() const { return sum_ / static_cast<float>(count_); }
  /// Of the mean's luminance, as if the samples did not know of each other: that of well-spread ones is smaller.
  float variance() const;

 private:
  Eigen::Vector3f sum_ = Eigen::Vector3f::Zero();
  float squares_ = 0;
  std::uint32_t count_ = 0;
};

/// What a pixel shows, where it shows the object.
struct PathGuide {
  LightGuide surface;
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  Finish finish;
  bool seen = false;
};

/// Pixels of a part of the picture, row by row.
struct PathGrid {
  PathGrid(int width, int height)
      : columns(width),
        rows(height),
        lights(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        guides(lights.size()) {}
  PathGrid() = default;

  int columns = 0, rows = 0;
  std::vector<PathLight> lights;
  std::vector<PathGuide> guides;
};

/// The light of a pixel spreads 2^levels pixels far. `report` is called now and then with the fraction done.
void smooth_paths(PathGrid& grid, int levels, const std::function<void(double)>& report);

}  // namespace pelage

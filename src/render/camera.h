#pragma once
// A perspective camera that is placed so that an object fills the picture.

#include <Eigen/Core>
#include <vector>

namespace pelage {

struct Camera {
  Eigen::Vector3f position;
  Eigen::Vector3f right, up, back;  ///< orthonormal; the camera looks along -back
  float tan_x, tan_y;               ///< tangents of half the horizontal and vertical angle of view

  /// Unit direction through the place (x, y) of the picture, both in [-1, 1], x to the right and y upwards.
  Eigen::Vector3f direction(float x, float y) const;
  /// The inverse: where a point appears, in the same coordinates; not a number behind the camera.
  Eigen::Vector2f project(const Eigen::Vector3f& point) const;
};

/// The nearest camera with the given direction of view that has all points inside the picture, centred with equal
/// margins. y is up; azimuth 0 looks from +z, 90 degrees from +x; `aspect` is width over height; `margin` is
/// the free part of the picture on each side, below 0.5; `angle_degrees`: that the longer side sees. The usual one is
/// that of a short telephoto lens, as for products, since wider lenses swell what is near.
Camera frame_points(const std::vector<Eigen::Vector3f>& points, double azimuth_degrees, double elevation_degrees,
                    double aspect, double margin, double angle_degrees = 26);

/// Points that reach from everywhere around the upright axis through the middle of the given ones as far as those do
/// when they are turned around it: framed instead of them, they show the whole turn. The same for each azimuth, turned.
std::vector<Eigen::Vector3f> swept_around(const std::vector<Eigen::Vector3f>& points, double azimuth_degrees);

/// The camera at `position` that looks towards `towards`, with `up` upwards in the picture; both of any length, and not
/// parallel.
Camera placed_camera(const Eigen::Vector3f& position, const Eigen::Vector3f& towards, const Eigen::Vector3f& up,
                     double aspect, double angle_degrees);

}  // namespace pelage

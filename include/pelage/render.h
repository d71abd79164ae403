#pragma once
// Pictures of meshes as in a catalogue: soft light, a shadow on the ground, a plain backdrop. Link pelage::render.
//
//   pelage::write_png(pelage::render(coat), "coat.png");
//
// All errors are pelage::Error, see error.h.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "pelage/error.h"
#include "pelage/image.h"
#include "pelage/point.h"
#include "pelage/progress.h"
#include "pelage/triangle_mesh.h"
#include "pelage/up_axis.h"

namespace pelage {

/// The large soft lamp.
struct PictureLamp {
  double azimuth = -42;   ///< degrees to the right of the camera
  double elevation = 48;  ///< degrees above the floor, 10 to 90
  double size = 0.3;      ///< radius over distance, 0.02 to 1: shadows are as soft
};

/// A camera that stands where it is put, in the mesh's coordinates. The directions need not be of length 1, nor the
/// second one at a right angle to the first.
struct PictureCamera {
  Point position = {0, 0, 0};
  Point towards = {0, 0, -1};  ///< where it looks
  Point up = {0, 1, 0};        ///< of the picture
};

struct PictureOptions {
  int width = 1024;   ///< pixels, 1 to 32768
  int height = 1024;  ///< pixels, 1 to 32768
  int samples = 32;   ///< rays per pixel at edges; light is smoothed, over fewer pixels with more, from 512 not
  UpAxis up = UpAxis::y;
  double azimuth = 35;    ///< degrees around the up axis; 0 looks from +z (up y) or -y (up z), 90 from +x
  double elevation = 14;  ///< degrees above the horizon, -89 to 89
  std::array<double, 3> background = {0.80, 0.80, 0.79};  ///< colour of the backdrop, linear light
  double exposure = 0;                                    ///< stops: brighter by so many factors of two, -20 to 20
  PictureLamp lamp;
  double angle = 26;               ///< degrees that the longer side of the picture sees, 1 to 120: a lens of 78 mm
  double margin = 0.09;            ///< of the picture around the object, -0.45 to 0.45: below 0 it is cut off
  std::vector<Point> framed = {};  ///< what has to be seen, in the mesh's coordinates, instead of all of it
  std::optional<PictureCamera> camera = {};  ///< instead of azimuth, elevation, margin and framed
  bool steady = false;  ///< framed so that nothing is cut off or changes its size when the azimuth changes
  bool ground = true;   ///< the object throws a shadow on the paper; else it stands before it
  bool denoise = true;  ///< light of few rays is smoothed
  bool dither = true;   ///< 0.5 % of noise, lest 8 bits show the even backdrop in bands; for more bits leave it out
};

/// The angle that the longer side of a picture sees through a lens of so many millimetres before film of 36 mm
/// [degrees].
double angle_of_lens(double millimetres);

/// The mesh on the ground before a seamless backdrop, framed so that it fills the picture. "color" (linear), "normal"
/// and the attributes of channel.h at the vertices are interpolated; without normals the faces are flat, without
/// colours they are grey. The same bits for any number of threads. Errors: Fault::usage for options outside their
/// ranges, Fault::input for a mesh without extent, Fault::cancelled when `progress` asks to stop.
Image render(const TriangleMesh& mesh, const PictureOptions& options = {}, const Progress& progress = {});

/// Several pictures of one mesh, which is prepared for rays once for each axis that points up. Not copyable; use it
/// from one thread at a time (it uses several itself).
class PictureScene {
 public:
  explicit PictureScene(TriangleMesh mesh);
  ~PictureScene();
  PictureScene(PictureScene&&) noexcept;
  PictureScene& operator=(PictureScene&&) noexcept;

  /// As the function above, with its errors.
  Image render(const PictureOptions& options = {}, const Progress& progress = {});

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage

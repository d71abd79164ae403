#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/parallel.h"
#include "pelage/render.h"
#include "render/camera.h"
#include "render/ray_scene.h"
#include "render/sampler.h"
#include "render/studio.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

/// What the random numbers of a sample are used for; each use has its own sequence.
enum Use : std::uint32_t { use_pixel = 1, use_key = 2, use_bounce = 3, use_second_key = 4, use_dither = 5 };

/// Random points for one sample of one pixel.
struct Sample {
  std::uint32_t index;
  std::array<float, 2> operator()(Use use) const { return scrambled_sobol(index, use); }
};

/// The object turned upright, scaled to a bounding sphere of diameter 1 and put on the ground y = 0.
std::vector<Vector3f> stand_upright(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : mesh.triangles)
    for (std::int32_t v : t) box.extend(rotation * Eigen::Map<const Eigen::Vector3d>(mesh.points[v].data()));
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  if (!(size > 0) || !std::isfinite(size)) throw Error(Fault::input, "the mesh has no extent; there is nothing to see");
  const Eigen::Vector3d foot(box.center().x(), box.min().y(), box.center().z());
  std::vector<Vector3f> points;
  for (const Point& p : mesh.points)
    points.push_back(((rotation * Eigen::Map<const Eigen::Vector3d>(p.data()) - foot) / size).cast<float>());
  return points;
}

Eigen::Matrix3d upright_rotation(UpAxis up) {
  if (up == UpAxis::y) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0,  //
      0, 0, 1,          //
      0, -1, 0;
  return rotation;
}

/// A mesh that stands on the ground, for rays to be shot at.
struct StandingMesh {
  StandingMesh(const TriangleMesh& mesh, UpAxis up_axis)
      : up(up_axis),
        points(stand_upright(mesh, upright_rotation(up))),
        scene(mesh, points, upright_rotation(up).cast<float>()) {}

  UpAxis up;
  std::vector<Vector3f> points;
  RayScene scene;
};

class Painter {
 public:
  Painter(const StandingMesh& model, const PictureOptions& options)
      : options_(options),
        scene_(model.scene),
        camera_(frame_points(model.points, options.azimuth, options.elevation, aspect(options), margin)),
        studio_(camera_.back, Eigen::Map<const Eigen::Vector3d>(options.background.data()).cast<float>()) {}

  Vector3f pixel(int x, int y) const;

 private:
  static constexpr double margin = 0.09;
  static double aspect(const PictureOptions& o) { return static_cast<double>(o.width) / o.height; }

  Vector3f path(float x, float y, const Sample& sample) const;
  Vector3f surface(const SurfacePoint& point, const Vector3f& direction, const Sample& sample) const;
  Vector3f ground(const Vector3f& place, const Sample& sample) const;
  Vector3f arriving(const Vector3f& origin, const Vector3f& direction, const Sample& sample) const;
  Vector3f bounced(const Vector3f& origin, const Vector3f& normal, const Vector3f& color, const Sample& sample) const;

  PictureOptions options_;
  const RayScene& scene_;
  Camera camera_;
  Studio studio_;
};

/// The part of the room's light that still arrives after two bounces, as a share of a white surface: without it
/// creases would go black. A guess that is right for the middle of a matt half-closed hollow.
constexpr float remaining_light = 0.22F;

/// Light that a matt surface sends on after the first bounce: key lamp with its shadow, and a guess for the rest.
Vector3f Painter::bounced(const Vector3f& origin, const Vector3f& normal, const Vector3f& color,
                          const Sample& sample) const {
  const Vector3f to_key = studio_.key_direction(sample(use_second_key));
  const float cosine = normal.dot(to_key);
  Vector3f light = Vector3f::Constant(remaining_light);
  if (cosine > 0 && !scene_.occluded(origin, to_key)) light += cosine * studio_.key();
  return color.cwiseProduct(light);
}

/// Light that comes to `origin` from `direction`.
Vector3f Painter::arriving(const Vector3f& origin, const Vector3f& direction, const Sample& sample) const {
  if (const auto hit = scene_.intersect(origin, direction))
    return bounced(hit->lifted, hit->normal, hit->color, sample);
  if (direction.y() >= 0) return studio_.room(direction);
  constexpr float above_ground = 1e-4F;
  Vector3f place = origin - direction * (origin.y() / direction.y());
  place.y() = above_ground;
  return bounced(place, Vector3f::UnitY(), studio_.paper(), sample);
}

/// Fresnel reflectance of hair and skin at a cosine (Schlick 1994), index of refraction about 1.5.
float fresnel(float cosine) {
  constexpr float facing = 0.04F;
  const float x = 1 - std::clamp(cosine, 0.0F, 1.0F);
  return facing + (1 - facing) * (x * x) * (x * x) * x;
}

/// Microfacet highlight for light of unit irradiance over pi (GGX; Walter et al. 2007, with the visibility term
/// of Karis 2013), times the cosine at the surface.
float highlight(const Vector3f& normal, const Vector3f& view, const Vector3f& light) {
  constexpr float alpha = 0.22F;  // a brushed coat: broad and soft
  constexpr float alpha2 = alpha * alpha;
  const Vector3f half = (view + light).normalized();
  const float nv = std::max(0.05F, normal.dot(view)), nl = normal.dot(light), nh = normal.dot(half);
  if (nl <= 0) return 0;
  const float d = nh * nh * (alpha2 - 1) + 1;
  constexpr float k = alpha / 2;
  const float visibility = 1 / (4 * (nv * (1 - k) + k) * (nl * (1 - k) + k));
  return alpha2 / (d * d) * visibility * fresnel(view.dot(half)) * nl;
}

Vector3f Painter::surface(const SurfacePoint& point, const Vector3f& direction, const Sample& sample) const {
  const Vector3f view = -direction;
  Vector3f color = Vector3f::Zero();
  const Vector3f to_key = studio_.key_direction(sample(use_key));
  const float cosine = point.normal.dot(to_key);
  if (cosine > 0 && !scene_.occluded(point.lifted, to_key)) {
    const float gloss = highlight(point.normal, view, to_key);
    color += (point.color * cosine + Vector3f::Constant(gloss)).cwiseProduct(studio_.key());
  }
  const Vector3f outward = cosine_direction(point.normal, sample(use_bounce));
  if (outward.dot(point.face_normal) <= 0) return color;
  const Vector3f light = arriving(point.lifted, outward, sample);
  // The sheen of the room: rough fur reflects about a third of what a polished surface would at grazing angles.
  constexpr float roughness_loss = 0.35F;
  const float sheen = roughness_loss * fresnel(point.normal.dot(view));
  return color + light.cwiseProduct((1 - sheen) * point.color + Vector3f::Constant(sheen));
}

/// How much of its light the ground keeps beside the object, per colour.
Vector3f Painter::ground(const Vector3f& place, const Sample& sample) const {
  const Vector3f up = Vector3f::UnitY();
  const Vector3f to_key = studio_.key_direction(sample(use_key));
  const Vector3f upward = cosine_direction(up, sample(use_bounce));
  const Vector3f open_key = to_key.y() * studio_.key(), open_room = studio_.room(upward);
  Vector3f light = scene_.occluded(place, to_key) ? Vector3f::Zero().eval() : open_key;
  light += arriving(place, upward, sample);
  return light.cwiseQuotient(open_key + open_room);
}

Vector3f Painter::path(float x, float y, const Sample& sample) const {
  const Vector3f direction = camera_.direction(x, y);
  if (const auto hit = scene_.intersect(camera_.position, direction)) return surface(*hit, direction, sample);
  const Vector3f paper = studio_.backdrop(x, y);
  if (direction.y() >= 0 || camera_.position.y() <= 0) return paper;
  constexpr float above_ground = 1e-4F, far_away = 4;  // object sizes: no shadow reaches there
  Vector3f place = camera_.position - direction * (camera_.position.y() / direction.y());
  place.y() = above_ground;
  if (place.norm() > far_away) return paper;
  return paper.cwiseProduct(ground(place, sample));
}

/// Density of a tent of half-width 1 pixel around 0, by inversion.
float tent(float random) { return random < 0.5F ? std::sqrt(2 * random) - 1 : 1 - std::sqrt(2 - 2 * random); }

/// Whether the paths of a pixel agree so well that more of them cannot change its 8 bits: plain backdrop.
class Agreement {
 public:
  void add(const Vector3f& color) {
    low_ = low_.cwiseMin(color);
    high_ = high_.cwiseMax(color);
  }
  bool reached() const { return (high_ - low_).maxCoeff() < 0.002F; }  // half a step of sRGB at light grey

 private:
  Vector3f low_ = Vector3f::Constant(1e9F), high_ = Vector3f::Constant(-1e9F);
};

/// Noise of half a step of 8-bit sRGB at light grey, or the even backdrop would show bands.
float dither(std::uint32_t index) {
  constexpr float step = 0.01F;  // relative, in linear light
  return 1 + step * (scrambled_sobol(index, use_dither)[0] - 0.5F);
}

Vector3f Painter::pixel(int x, int y) const {
  const auto block = std::bit_ceil(static_cast<std::uint32_t>(options_.samples));
  const std::uint32_t number = z_order(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  constexpr int enough_if_agreed = 8;
  Vector3f sum = Vector3f::Zero();
  Agreement agreement;
  int count = 0;
  while (count < options_.samples && !(count == enough_if_agreed && agreement.reached())) {
    const Sample sample{number * block + static_cast<std::uint32_t>(count++)};
    const std::array<float, 2> place = sample(use_pixel);
    const float px = static_cast<float>(x) + 0.5F + tent(place[0]), py = static_cast<float>(y) + 0.5F + tent(place[1]);
    const auto width = static_cast<float>(options_.width), height = static_cast<float>(options_.height);
    const Vector3f color = path(2 * px / width - 1, 1 - 2 * py / height, sample);
    sum += color;
    agreement.add(color);
  }
  return sum * (dither(number) / static_cast<float>(count));
}

void check(const PictureOptions& options) {
  constexpr int largest = 32768;  // z_order has 16 bits per axis
  const auto inside = [](double x, double low, double high) { return x >= low && x <= high; };
  if (!inside(options.width, 1, largest) || !inside(options.height, 1, largest))
    throw Error(Fault::usage, "the picture's width and height must lie between 1 and 32768 pixels");
  if (!inside(options.samples, 1, 65536))
    throw Error(Fault::usage, "the samples per pixel must lie between 1 and 65536");
  if (!inside(options.elevation, -89, 89) || !inside(options.azimuth, -3600, 3600))
    throw Error(Fault::usage,
                "the camera's elevation must lie between -89 and 89 degrees, its azimuth within ten turns");
}

Image picture(const StandingMesh& model, const PictureOptions& options, const Progress& progress) {
  const Painter painter(model, options);
  Image image{options.width, options.height, std::vector<float>(std::size_t{3} * options.width * options.height)};
  constexpr int band = 32;              // rows between two reports
  constexpr std::size_t portion = 256;  // pixels that a thread takes at a time
  for (int top = 0; top < options.height; top += band) {
    if (progress && !progress("picture", static_cast<double>(top) / options.height))
      throw Error(Fault::cancelled, "the picture was cancelled");
    const int rows = std::min(band, options.height - top);
    parallel_for(
        static_cast<std::size_t>(rows) * options.width,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const std::size_t pixel = static_cast<std::size_t>(top) * options.width + i;
            const int x = static_cast<int>(pixel % options.width), y = static_cast<int>(pixel / options.width);
            Eigen::Map<Vector3f>(image.rgb.data() + 3 * pixel) = painter.pixel(x, y);
          }
        },
        portion);
  }
  return image;
}

}  // namespace

struct PictureScene::Parts {
  explicit Parts(TriangleMesh given) : mesh(std::move(given)) {}
  TriangleMesh mesh;
  std::optional<StandingMesh> model;  ///< for the last axis that pointed up
};

PictureScene::PictureScene(TriangleMesh mesh) : parts_(std::make_unique<Parts>(std::move(mesh))) {}
PictureScene::~PictureScene() = default;
PictureScene::PictureScene(PictureScene&&) noexcept = default;
PictureScene& PictureScene::operator=(PictureScene&&) noexcept = default;

Image PictureScene::render(const PictureOptions& options, const Progress& progress) {
  check(options);
  std::optional<StandingMesh>& model = parts_->model;
  if (!model || model->up != options.up) model.emplace(parts_->mesh, options.up);
  return picture(*model, options, progress);
}

Image render(const TriangleMesh& mesh, const PictureOptions& options, const Progress& progress) {
  check(options);
  return picture(StandingMesh(mesh, options.up), options, progress);
}

}  // namespace pelage

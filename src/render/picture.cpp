#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "pelage/render.h"
#include "render/painter.h"
#include "render/ray_scene.h"
#include "render/smooth_light.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

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
  StandingMesh(const TriangleMesh& mesh, UpAxis up_axis, const std::function<bool(double)>& report)
      : up(up_axis),
        points(stand_upright(mesh, upright_rotation(up))),
        scene(mesh, points, upright_rotation(up).cast<float>(), report) {}

  UpAxis up;
  std::vector<Vector3f> points;
  RayScene scene;
};

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

/// Fractions of something that takes the part from `begin` to `end` of the whole.
struct Part {
  const Progress& progress;
  double begin, end;

  bool go_on(double fraction) const { return !progress || progress("picture", begin + (end - begin) * fraction); }
  void report(double fraction) const {
    if (!go_on(fraction)) throw Error(Fault::cancelled, "the picture was cancelled");
  }
  Part part(double from, double to) const {
    return {progress, begin + (end - begin) * from, begin + (end - begin) * to};
  }
};

/// With many rays there is less noise to be smoothed, and with very many none.
Rays rays_of(int samples) {
  const auto count = static_cast<std::uint32_t>(samples);
  Rays rays{std::max(1U, count / 2), std::max(1U, count / 8), 0};
  constexpr std::uint32_t enough = 64;
  for (std::uint32_t light = rays.light; light < enough && rays.levels < 4; light *= 2) ++rays.levels;
  return rays;
}

class Picture {
 public:
  Picture(const StandingMesh& model, const TriangleMesh& mesh, const PictureOptions& options)
      : rays_(rays_of(options.samples)),
        painter_(model.scene, model.points, mesh.triangles, options, rays_),
        image_{options.width, options.height, std::vector<float>(std::size_t{3} * options.width * options.height)} {}

  Image paint(const Part& whole) {
    const int tiles = std::max(most_pixels / image_.width, 4 * light_reach(rays_.levels)) / Painter::tile;
    const int rows = std::max(1, tiles) * Painter::tile;
    const double all = cost(0, image_.height);
    for (int top = 0; top < image_.height; top += rows) {
      const int bottom = std::min(top + rows, image_.height);
      paint_rows(top, bottom, whole.part(cost(0, top) / all, cost(0, bottom) / all));
    }
    return std::move(image_);
  }

 private:
  static constexpr int most_pixels = 1 << 19;  // at a time; each takes 200 bytes

  /// Time that rows take, in units of that of a square without the object.
  double cost(int top, int bottom) const {
    constexpr double busy = 12;
    double sum = 0;
    for (int row = top / Painter::tile; row * Painter::tile < bottom; ++row)
      for (int column = 0; column * Painter::tile < image_.width; ++column)
        sum += painter_.busy(column, row) ? busy : 1;
    return sum;
  }

  void paint_rows(int top, int bottom, const Part& part) {
    constexpr double traced = 0.8, coat_smoothed = 0.9;  // shares of the time
    // Whole squares, in which the painter looks for what is worth its rays.
    const int reach = (light_reach(rays_.levels) + Painter::tile - 1) / Painter::tile * Painter::tile;
    const int first = std::max(0, top - reach), last = std::min(image_.height, bottom + reach);
    Band band(first, last - first, image_.width);
    trace(band, part.part(0, traced));
    const auto smooth = [&](auto& light, const std::vector<LightGuide>& guides, const Part& share) {
      smooth_light(light, guides, band.width, painter_.floor_stretch(), rays_.levels,
                   [&](double fraction) { share.report(fraction); });
    };
    smooth(band.coat, band.guides, part.part(traced, coat_smoothed));
    smooth(band.floor, {}, part.part(coat_smoothed, 1));
    parallel_for(static_cast<std::size_t>(bottom - top) * band.width, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int x = static_cast<int>(i) % band.width, y = top + static_cast<int>(i) / band.width;
        const std::size_t pixel = static_cast<std::size_t>(y) * band.width + x;
        Eigen::Map<Vector3f>(image_.rgb.data() + 3 * pixel) = painter_.color(band, x, y);
      }
    });
  }

  void trace(Band& band, const Part& part) const {
    const int columns = (band.width + Painter::tile - 1) / Painter::tile;
    const int first = band.first / Painter::tile, last = (band.first + band.rows - 1) / Painter::tile;
    const std::size_t tiles = static_cast<std::size_t>(columns) * (last - first + 1);
    // Neighbours take equally long; with strides between them every portion takes as long as any other.
    const std::size_t stride = coprime_stride(tiles);
    const std::size_t few = std::min<std::size_t>(64, 1024 / rays_.view);  // squares between reports
    const std::size_t portion = std::max(few, static_cast<std::size_t>(concurrency()));
    for (std::size_t begin = 0; begin < tiles; begin += portion) {
      part.report(static_cast<double>(begin) / static_cast<double>(tiles));
      parallel_chunks(std::min(portion, tiles - begin), [&](std::size_t i) {
        const auto t = static_cast<int>((begin + i) * stride % tiles);
        painter_.trace(band, t % columns, first + t / columns);
      });
    }
  }

  /// Near the golden section of n and coprime to it.
  static std::size_t coprime_stride(std::size_t n) {
    auto stride = static_cast<std::size_t>(0.618 * static_cast<double>(n)) + 1;
    while (std::gcd(stride, n) != 1) ++stride;
    return stride;
  }

  Rays rays_;
  Painter painter_;
  Image image_;
};

/// The part of the time that goes into the tree of the rays.
double building_share(std::size_t triangles, const PictureOptions& options) {
  const double rays = static_cast<double>(options.width) * options.height * options.samples / 8;
  return static_cast<double>(triangles) / (static_cast<double>(triangles) + rays);
}

/// `model` is made if it does not stand as wanted.
Image picture(const TriangleMesh& mesh, std::optional<StandingMesh>& model, const PictureOptions& options,
              const Progress& progress) {
  check(options);
  const Part whole{progress, 0, 1};
  whole.report(0);
  double built = 0;
  if (!model || model->up != options.up) {
    built = building_share(mesh.triangles.size(), options);
    model.reset();
    model.emplace(mesh, options.up, [&](double fraction) { return whole.part(0, built).go_on(fraction); });
  }
  return Picture(*model, mesh, options).paint(whole.part(built, 1));
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
  return picture(parts_->mesh, parts_->model, options, progress);
}

Image render(const TriangleMesh& mesh, const PictureOptions& options, const Progress& progress) {
  std::optional<StandingMesh> model;
  return picture(mesh, model, options, progress);
}

}  // namespace pelage

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "pelage/render.h"
#include "render/painter.h"
#include "render/ray_scene.h"
#include "render/smooth_light.h"
#include "shape/discs.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

/// A box around all that extend(index below n, box) puts into its part.
template <class Extend>
Eigen::AlignedBox3d joined(std::size_t n, const Extend& extend) {
  std::vector<Eigen::AlignedBox3d> parts(chunk_count(n));
  parallel_for(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) extend(i, parts[begin / default_chunk]);
  });
  Eigen::AlignedBox3d box;
  for (const Eigen::AlignedBox3d& part : parts) box.extend(part);
  return box;
}

Eigen::Vector3d turned(const std::vector<Point>& points, const Eigen::Matrix3d& rotation, std::size_t v) {
  return rotation * Eigen::Map<const Eigen::Vector3d>(points[v].data());
}

/// Around the object turned upright.
Eigen::AlignedBox3d upright_box(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
  Eigen::AlignedBox3d box = joined(mesh.triangles.size(), [&](std::size_t i, Eigen::AlignedBox3d& part) {
    for (std::int32_t v : mesh.triangles[i]) part.extend(turned(mesh.points, rotation, static_cast<std::size_t>(v)));
  });
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  if (!(size > 0) || !std::isfinite(size)) throw Error(Fault::input, "the mesh has no extent; there is nothing to see");
  return box;
}

/// The object turned upright, scaled to a bounding sphere of diameter 1 and put on the ground y = 0.
std::vector<Vector3f> stand_upright(const std::vector<Point>& given, const Eigen::Matrix3d& rotation,
                                    const Eigen::AlignedBox3d& box) {
  const double size = box.diagonal().norm();
  const Eigen::Vector3d foot(box.center().x(), box.min().y(), box.center().z());
  std::vector<Vector3f> points(given.size());
  parallel_for(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) points[v] = ((turned(given, rotation, v) - foot) / size).cast<float>();
  });
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
        box(upright_box(mesh, upright_rotation(up))),
        points(stand_upright(mesh.points, upright_rotation(up), box)),
        scene(mesh, points, upright_rotation(up).cast<float>(), report, static_cast<float>(1 / box.diagonal().norm())) {
  }

  Camera camera(const PictureOptions& o) const {
    const double aspect = static_cast<double>(o.width) / o.height;
    const Eigen::Matrix3d rotation = upright_rotation(up);
    if (!o.camera) {
      const std::vector<Vector3f> framed = stand_upright(o.framed, rotation, box);
      const std::vector<Vector3f>& seen = framed.empty() ? points : framed;
      return frame_points(o.steady ? swept_around(seen, o.azimuth) : seen, o.azimuth, o.elevation, aspect, o.margin,
                          o.angle);
    }
    const auto direction = [&](const Point& d) -> Vector3f {
      return (rotation * Eigen::Map<const Eigen::Vector3d>(d.data())).normalized().cast<float>();
    };
    return placed_camera(stand_upright({o.camera->position}, rotation, box).front(), direction(o.camera->towards),
                         direction(o.camera->up), aspect, o.angle);
  }

  UpAxis up;
  Eigen::AlignedBox3d box;
  std::vector<Vector3f> points;
  RayScene scene;
};

void check(const PictureCamera& camera) {
  const Eigen::Map<const Eigen::Vector3d> towards(camera.towards.data()), up(camera.up.data());
  constexpr double least = 1e-6;  // sine of the angle between them
  const double lengths = towards.norm() * up.norm();
  if (!(towards.cross(up).norm() > least * lengths) || !std::isfinite(lengths) ||
      !Eigen::Map<const Eigen::Vector3d>(camera.position.data()).allFinite())
    throw Error(Fault::usage, "the camera's place must be finite, and what is up for it not where it looks");
}

void check(const PictureOptions& options) {
  constexpr int largest = 32768;  // z_order has 16 bits per axis
  const auto inside = [](double x, double low, double high) { return x >= low && x <= high; };
  if (!inside(options.width, 1, largest) || !inside(options.height, 1, largest))
    throw Error(Fault::usage, "the picture's width and height must lie between 1 and 32768 pixels");
  if (!inside(options.samples, 1, 65536))
    throw Error(Fault::usage, "the samples per pixel must lie between 1 and 65536");
  if (!inside(options.exposure, -20, 20))
    throw Error(Fault::usage, "the picture's exposure must lie between -20 and 20 stops");
  if (!inside(options.elevation, -89, 89) || !inside(options.azimuth, -3600, 3600))
    throw Error(Fault::usage,
                "the camera's elevation must lie between -89 and 89 degrees, its azimuth within ten turns");
  if (!inside(options.angle, 1, 120) || !inside(options.margin, -0.45, 0.45))
    throw Error(Fault::usage,
                "the camera's angle must lie between 1 and 120 degrees, its margin between -0.45 and 0.45");
  if (options.camera) check(*options.camera);
  if (!inside(options.lamp.elevation, 10, 90) || !inside(options.lamp.size, 0.02, 1))
    throw Error(Fault::usage, "the lamp's elevation must lie between 10 and 90 degrees, its size between 0.02 and 1");
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

/// With many rays there is less noise to be smoothed, and with very many none; very few are spared places instead.
Rays rays_of(int samples, bool denoise) {
  const auto count = static_cast<std::uint32_t>(samples);
  Rays rays{std::max(1U, count / 2), std::max(1U, count / 8), 1, 0};
  constexpr std::uint32_t enough = 64, few = 2;
  if (rays.light >= enough || !denoise) return rays;
  if (rays.light < few) return {rays.view, 4 * rays.light, 4, 3};
  rays.cell = 2;
  rays.levels = 1;
  for (std::uint32_t light = 2 * rays.light; light < enough && rays.levels < 4; light *= 2) ++rays.levels;
  return rays;
}

class Picture {
 public:
  Picture(const StandingMesh& model, const TriangleMesh& mesh, const PictureOptions& options)
      : rays_(rays_of(options.samples, options.denoise)),
        plain_(model.scene.plain()),
        painter_(model.scene, model.points, model.camera(options), mesh.triangles, options, rays_),
        exposure_(static_cast<float>(std::exp2(options.exposure))),
        image_{options.width, options.height, std::vector<float>(std::size_t{3} * options.width * options.height)} {}

  Image paint(const Part& whole) {
    const int tiles = std::max(most_pixels / image_.width, 4 * reach()) / Painter::tile;
    const int rows = std::max(1, tiles) * Painter::tile;
    const double all = cost(0, image_.height);
    for (int top = 0; top < image_.height; top += rows) {
      const int bottom = std::min(top + rows, image_.height);
      paint_rows(top, bottom, whole.part(cost(0, top) / all, cost(0, bottom) / all));
    }
    return std::move(image_);
  }

 private:
  static constexpr int most_pixels = 1 << 20;  // at a time; each takes 80 bytes, with paths 200

  /// Time that rows take, in units of that of a square without the object.
  double cost(int top, int bottom) const {
    constexpr double busy = 12;
    double sum = 0;
    for (int row = top / Painter::tile; row * Painter::tile < bottom; ++row)
      for (int column = 0; column * Painter::tile < image_.width; ++column)
        sum += painter_.busy(column, row) ? busy : 1;
    return sum;
  }

  /// Of the time that is over when the steps end.
  std::array<double, 4> shares() const {
    if (plain_) return {0.43, 0.66, 0.75, 0.75};
    return {0.1, 0.15, 0.2, 0.95};
  }

  /// They reach as far as light does.
  int path_levels() const { return rays_.levels == 0 ? 0 : std::bit_width(static_cast<unsigned>(reach())) - 1; }
  int reach() const { return light_reach(rays_.levels, rays_.cell); }

  void paint_rows(int top, int bottom, const Part& part) {
    const auto share = shares();
    const double looked = share[0], lit = share[1], smoothed = share[2], traced = share[3];
    // Whole squares, in which the painter looks for what is worth its rays.
    const int around = (reach() + Painter::tile - 1) / Painter::tile * Painter::tile;
    const int first = std::max(0, top - around), last = std::min(image_.height, bottom + around);
    Band band = painter_.band(first, last - first);
    for_squares(first, last, part.part(0, looked), [&](int column, int row) { painter_.look(band, column, row); });
    find_closeness(band.coat);
    find_closeness(band.floor);
    for_squares(first, last, part.part(looked, lit),
                [&](int column, int row) { painter_.light_more(band, column, row); });
    const Part smoothing = part.part(lit, smoothed);
    smooth_light(band.coat, rays_.levels, [&](double fraction) { smoothing.report(fraction / 2); });
    smooth_light(band.floor, rays_.levels, [&](double fraction) { smoothing.report((1 + fraction) / 2); });
    if (traced > smoothed) {
      for_squares(first, last, part.part(smoothed, traced),
                  [&](int column, int row) { painter_.trace(band, column, row); });
      smooth_paths(band.paths, path_levels(), [&](double) { part.report(traced); });
    }
    for_squares(top, bottom, part.part(traced, 1), [&](int column, int row) { color(band, column, row); });
  }

  void color(const Band& band, int column, int row) {
    const int right = std::min((column + 1) * Painter::tile, image_.width),
              bottom = std::min((row + 1) * Painter::tile, image_.height);
    for (int y = row * Painter::tile; y < bottom; ++y)
      for (int x = column * Painter::tile; x < right; ++x)
        Eigen::Map<Vector3f>(image_.rgb.data() + 3 * (static_cast<std::size_t>(y) * image_.width + x)) =
            exposure_ * painter_.color(band, x, y);
  }

  /// Calls visit(column, row) for all squares of these rows, from several threads.
  template <class Visit>
  void for_squares(int top, int bottom, const Part& part, Visit&& visit) const {
    const int columns = (image_.width + Painter::tile - 1) / Painter::tile;
    const int first = top / Painter::tile, last = (bottom - 1) / Painter::tile;
    const std::size_t squares = static_cast<std::size_t>(columns) * (last - first + 1);
    // Neighbours take equally long; with strides between them every portion takes as long as any other.
    const std::size_t stride = coprime_stride(squares);
    const std::size_t few = std::min<std::size_t>(64, 1024 / rays_.view);  // between reports
    const std::size_t portion = std::max(few, static_cast<std::size_t>(concurrency()));
    for (std::size_t begin = 0; begin < squares; begin += portion) {
      part.report(static_cast<double>(begin) / static_cast<double>(squares));
      parallel_chunks(std::min(portion, squares - begin), [&](std::size_t i) {
        const auto s = static_cast<int>((begin + i) * stride % squares);
        visit(s % columns, first + s / columns);
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
  bool plain_;
  Painter painter_;
  float exposure_;
  Image image_;
};

/// The part of the time that goes into the tree of the rays, which is built by one thread: a triangle of it takes as
/// long as half a pixel of the usual quality.
double building_share(std::size_t triangles, const PictureOptions& options) {
  constexpr int usual_samples = 32;
  const double rays = 1 + static_cast<double>(options.samples) / usual_samples;
  const double painting = static_cast<double>(options.width) * options.height * rays / concurrency();
  return static_cast<double>(triangles) / (static_cast<double>(triangles) + painting);
}

/// Of clouds of points their discs are seen.
TriangleMesh seen(TriangleMesh mesh) { return mesh.triangles.empty() ? discs_of(mesh) : std::move(mesh); }

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
  explicit Parts(TriangleMesh given) : mesh(seen(std::move(given))) {}
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
  if (mesh.triangles.empty()) return picture(discs_of(mesh), model, options, progress);
  return picture(mesh, model, options, progress);
}

}  // namespace pelage

#include "render/ray_scene.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "pelage/error.h"
#include "shape/normals.h"
#include "shape/relief.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

/// Distance at which rays leave a surface, in units of the object's size: far above the rounding of floats,
/// far below a pixel.
constexpr float lift = 1e-4F;

/// Squared length below which normals have cancelled each other and say nothing.
constexpr float least_normal = 0.01F;

/// The colour of a mesh without colours: unglazed clay.
const Vector3f clay(0.55F, 0.52F, 0.48F);

std::vector<Vector3f> vertex_vectors(const TriangleMesh& mesh, const char* name) {
  const Attribute* attribute = mesh.find(name);
  std::vector<Vector3f> vectors;
  if (!attribute || attribute->domain != Domain::vertex || attribute->components < 3) return vectors;
  vectors.resize(attribute->values.size() / attribute->components);
  parallel_for(vectors.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      vectors[i] = Eigen::Map<const Eigen::Vector3d>(&attribute->values[i * attribute->components]).cast<float>();
  });
  return vectors;
}

const std::vector<double>* channel(const TriangleMesh& mesh, Channel channel) {
  const Attribute* attribute = mesh.find(kind_of(channel).attribute);
  const bool fits = attribute && attribute->domain == Domain::vertex && attribute->components == 1;
  return fits ? &attribute->values : nullptr;
}

/// Where the mesh has one, clamped to its range.
void read_channel(const TriangleMesh& mesh, Channel kind, float Finish::*member, float scale,
                  std::vector<Finish>& finishes) {
  const std::vector<double>* values = channel(mesh, kind);
  if (!values) return;
  finishes.resize(mesh.points.size());
  const double unit = kind_of(kind).length ? scale : 1;
  for (std::size_t v = 0; v < finishes.size(); ++v)
    finishes[v].*member = static_cast<float>(unit * std::clamp((*values)[v], kind_of(kind).low, kind_of(kind).high));
}

std::vector<Finish> finishes_of(const TriangleMesh& mesh, float scale) {
  std::vector<Finish> finishes;
  for (const auto& [kind, member] : {std::pair{Channel::roughness, &Finish::roughness},
                                     {Channel::metalness, &Finish::metalness},
                                     {Channel::opacity, &Finish::opacity},
                                     {Channel::emission, &Finish::emission},
                                     {Channel::transmission, &Finish::transmission},
                                     {Channel::thickness, &Finish::thickness}})
    read_channel(mesh, kind, member, scale, finishes);
  return finishes;
}

/// Normals with the slopes of the heights, if there are any.
std::vector<Vector3f> tilted_normals(const TriangleMesh& mesh) {
  std::vector<Vector3f> normals;
  if (const std::vector<double>* height = channel(mesh, Channel::height))
    for (const Point& n : relief_normals(mesh, normals_of(mesh), *height))
      normals.push_back(Eigen::Map<const Eigen::Vector3d>(n.data()).cast<float>());
  return normals;
}

/// Even in [0, 1), and the same for the same place.
float random_of(const Hit& hit) {
  const std::uint64_t place =
      (std::uint64_t{std::bit_cast<std::uint32_t>(hit.u)} << 32) | std::bit_cast<std::uint32_t>(hit.v);
  return static_cast<float>(hash(hit.triangle, place) >> 40) * 0x1p-24F;
}

RTCRay make_ray(const Vector3f& origin, const Vector3f& direction) {
  RTCRay ray{};
  ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tnear = 0;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = 0xffffffff;
  return ray;
}

RTCRayHit make_query(const Vector3f& origin, const Vector3f& direction) {
  RTCRayHit query{make_ray(origin, direction), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

Hit found(const RTCRayHit& query) {
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const bool known = std::isfinite(query.hit.u) && std::isfinite(query.hit.v);  // not in triangles without an area
  return {query.hit.primID, known ? query.hit.u : 0, known ? query.hit.v : 0};
}

/// Mean of a corner attribute.
Vector3f blend(const std::vector<Vector3f>& values, const Triangle& t, const Hit& hit) {
  return (1 - hit.u - hit.v) * values[t[0]] + hit.u * values[t[1]] + hit.v * values[t[2]];
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  using Report = std::function<bool(double)>;

  Embree() = default;
  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void build(const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles, bool careful,
             const Report& report) {
    device = rtcNewDevice(nullptr);
    if (device) scene = rtcNewScene(device);
    if (!scene) throw Error(Fault::numerics, "the ray tracer could not be started");
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no rays slip through between neighbouring triangles
    if (careful) rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vector3f),
                                             points.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle),
                                            triangles.size());
    std::copy(points.begin(), points.end(), static_cast<Vector3f*>(vertices));
    std::copy(triangles.begin(), triangles.end(), static_cast<Triangle*>(indices));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    commit(report);
  }

  /// Embree asks now and then whether to go on.
  void commit(const Report& report) {
    struct Asked {
      const Report& report;
      bool stopped = false;
      static bool go_on(void* asked, double fraction) {
        auto& self = *static_cast<Asked*>(asked);
        self.stopped = self.stopped || (self.report && !self.report(std::min(fraction, 1.0)));
        return !self.stopped;
      }
    } asked{report};
    rtcSetSceneProgressMonitorFunction(scene, &Asked::go_on, &asked);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (asked.stopped) throw Error(Fault::cancelled, "the picture was cancelled");
  }
};

/// Where a ray met something, and how far away.
struct RayScene::Met {
  Hit hit;
  float distance = std::numeric_limits<float>::infinity();
};

RayScene::RayScene(const TriangleMesh& mesh, const std::vector<Vector3f>& points, const Eigen::Matrix3f& rotation,
                   const std::function<bool(double)>& report, float scale)
    : points_(points),
      normals_(vertex_vectors(mesh, "normal")),
      colors_(vertex_vectors(mesh, "color")),
      tilted_(tilted_normals(mesh)),
      finishes_(finishes_of(mesh, scale)),
      see_through_(std::ranges::any_of(finishes_, [](const Finish& f) { return f.opaque() < 1; })),
      triangles_(mesh.triangles) {
  for (auto* normals : {&normals_, &tilted_})
    for (Vector3f& normal : *normals) normal = rotation * normal;
  embree_ = std::make_unique<Embree>();
  // The shape of Embree's tree, and with it the choice between two triangles at a shared edge, depends on the number of
  // threads that build it.
  run_on_one_thread([&] { embree_->build(points_, triangles_, !plain(), report); });
}

RayScene::~RayScene() = default;

void RayScene::intersect(const Vector3f& origin, std::span<const Vector3f> directions, std::span<Hit> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  std::array<RTCRayHit, widest_bundle> queries;
  assert(directions.size() <= widest_bundle && hits.size() == directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) queries[i] = make_query(origin, directions[i]);
  rtcIntersect1M(embree_->scene, &context, queries.data(), static_cast<unsigned>(directions.size()), sizeof(RTCRayHit));
  for (std::size_t i = 0; i < directions.size(); ++i) hits[i] = found(queries[i]);
}

std::optional<SurfacePoint> RayScene::meet(const Vector3f& origin, const Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = make_query(origin, direction);
  rtcIntersect1(embree_->scene, &context, &query);
  const Hit hit = found(query);
  if (hit.triangle == Hit::nothing) return std::nullopt;
  return surface_point(skin(direction, hit), hit);
}

std::optional<SurfacePoint> RayScene::intersect(const Vector3f& origin, const Vector3f& direction) const {
  const Hit hit = first_blocking(origin, direction).hit;
  if (hit.triangle == Hit::nothing) return std::nullopt;
  return surface_point(skin(direction, hit), hit);
}

bool RayScene::occluded(const Vector3f& origin, const Vector3f& direction) const {
  if (see_through_) return first_blocking(origin, direction).hit.triangle != Hit::nothing;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0;
}

float RayScene::distance(const Vector3f& origin, const Vector3f& direction) const {
  return first_blocking(origin, direction).distance;
}

RayScene::Met RayScene::first_blocking(const Vector3f& origin, const Vector3f& direction) const {
  constexpr int most = 64;  // layers, of which the last one blocks
  float near = 0;
  for (int layer = 0;; ++layer) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query = make_query(origin, direction);
    query.ray.tnear = near;
    rtcIntersect1(embree_->scene, &context, &query);
    const Met met{found(query), query.ray.tfar};
    if (met.hit.triangle == Hit::nothing || blocks(met.hit) || layer == most) return met;
    near = met.distance + lift;
  }
}

bool RayScene::blocks(const Hit& hit) const { return !see_through_ || random_of(hit) < finish(hit).shading(); }

Finish RayScene::finish(const Hit& hit) const {
  if (plain()) return {};
  const Triangle& t = triangles_[hit.triangle];
  const float weight[] = {1 - hit.u - hit.v, hit.u, hit.v};
  Finish mean{0, 0, 0, 0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) mean.add(weight[k], finishes_[t[k]]);
  return mean;
}

Vector3f RayScene::position(const Hit& hit) const { return blend(points_, triangles_[hit.triangle], hit); }

Vector3f RayScene::flat_normal(const Hit& hit) const {
  const Triangle& t = triangles_[hit.triangle];
  return (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized();
}

bool RayScene::from_behind(const Vector3f& direction, const Hit& hit) const {
  return flat_normal(hit).dot(direction) > 0;
}

Vector3f RayScene::shading_normal(const Hit& hit) const {
  const std::vector<Vector3f>& normals = tilted_.empty() ? normals_ : tilted_;
  return normals.empty() ? Vector3f::Zero().eval() : blend(normals, triangles_[hit.triangle], hit);
}

Skin RayScene::skin(const Vector3f& direction, const Hit& hit) const {
  Skin skin;
  skin.color = colors_.empty() ? clay : blend(colors_, triangles_[hit.triangle], hit);
  skin.face_normal = flat_normal(hit);
  if (!(skin.face_normal.squaredNorm() > 0)) skin.face_normal = -direction;
  if (skin.face_normal.dot(direction) > 0) skin.face_normal = -skin.face_normal;
  skin.normal = skin.face_normal;
  const Vector3f smooth = shading_normal(hit);
  if (smooth.squaredNorm() > least_normal)
    skin.normal = std::copysign(1.0F, smooth.dot(skin.face_normal)) * smooth.normalized();
  return skin;
}

SurfacePoint RayScene::surface_point(const Skin& skin, const Hit& hit) const {
  const Triangle& t = triangles_[hit.triangle];
  SurfacePoint point{skin, position(hit), {}, hit};
  point.lifted = point.position;
  const Vector3f smooth = normals_.empty() ? Vector3f::Zero().eval() : blend(normals_, t, hit);
  if (smooth.squaredNorm() > least_normal) {
    const float side = std::copysign(1.0F, smooth.dot(point.face_normal));
    // Hanika, "Hacking the Shadow Terminator" (Ray Tracing Gems II, 2021): start where the tangent planes of the
    // three corners meet above the flat triangle, lest each facet of a coarse mesh casts its own shadow.
    const float weight[] = {1 - hit.u - hit.v, hit.u, hit.v};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3f n = side * normals_[t[k]];
      const float below = std::min(0.0F, (point.position - points_[t[k]]).dot(n));
      point.lifted -= weight[k] * below * n;
    }
  }
  point.lifted += lift * point.face_normal;
  return point;
}

}  // namespace pelage

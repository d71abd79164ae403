#include "render/ray_scene.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "pelage/error.h"

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

  void build(const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles, const Report& report) {
    device = rtcNewDevice(nullptr);
    if (device) scene = rtcNewScene(device);
    if (!scene) throw Error(Fault::numerics, "the ray tracer could not be started");
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no rays slip through between neighbouring triangles
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

RayScene::RayScene(const TriangleMesh& mesh, const std::vector<Vector3f>& points, const Eigen::Matrix3f& rotation,
                   const std::function<bool(double)>& report)
    : points_(points),
      normals_(vertex_vectors(mesh, "normal")),
      colors_(vertex_vectors(mesh, "color")),
      triangles_(mesh.triangles) {
  for (Vector3f& normal : normals_) normal = rotation * normal;
  embree_ = std::make_unique<Embree>();
  // The shape of Embree's tree, and with it the choice between two triangles at a shared edge, depends on the number of
  // threads that build it.
  run_on_one_thread([&] { embree_->build(points_, triangles_, report); });
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

std::optional<SurfacePoint> RayScene::intersect(const Vector3f& origin, const Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = make_query(origin, direction);
  rtcIntersect1(embree_->scene, &context, &query);
  const Hit hit = found(query);
  if (hit.triangle == Hit::nothing) return std::nullopt;
  return surface_point(skin(direction, hit), hit);
}

bool RayScene::occluded(const Vector3f& origin, const Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0;
}

float RayScene::distance(const Vector3f& origin, const Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = make_query(origin, direction);
  rtcIntersect1(embree_->scene, &context, &query);
  return query.ray.tfar;
}

Vector3f RayScene::position(const Hit& hit) const { return blend(points_, triangles_[hit.triangle], hit); }

Skin RayScene::skin(const Vector3f& direction, const Hit& hit) const {
  const Triangle& t = triangles_[hit.triangle];
  Skin skin;
  skin.color = colors_.empty() ? clay : blend(colors_, t, hit);
  skin.face_normal = (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized();
  if (!(skin.face_normal.squaredNorm() > 0)) skin.face_normal = -direction;
  if (skin.face_normal.dot(direction) > 0) skin.face_normal = -skin.face_normal;
  skin.normal = skin.face_normal;
  const Vector3f smooth = normals_.empty() ? Vector3f::Zero().eval() : blend(normals_, t, hit);
  if (smooth.squaredNorm() > least_normal)
    skin.normal = std::copysign(1.0F, smooth.dot(skin.face_normal)) * smooth.normalized();
  return skin;
}

SurfacePoint RayScene::surface_point(const Skin& skin, const Hit& hit) const {
  const Triangle& t = triangles_[hit.triangle];
  SurfacePoint point{skin, position(hit), {}};
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

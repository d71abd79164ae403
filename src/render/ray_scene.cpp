#include "render/ray_scene.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <limits>

#include "base/parallel.h"
#include "pelage/error.h"

namespace pelage {

using Eigen::Vector3f;

namespace {

/// Distance at which rays leave a surface, in units of the object's size: far above the rounding of floats,
/// far below a pixel.
constexpr float lift = 1e-4F;

/// The colour of a mesh without colours: unglazed clay.
const Vector3f clay(0.55F, 0.52F, 0.48F);

std::vector<Vector3f> vertex_vectors(const TriangleMesh& mesh, const char* name) {
  const Attribute* attribute = mesh.find(name);
  std::vector<Vector3f> vectors;
  if (!attribute || attribute->domain != Domain::vertex || attribute->components < 3) return vectors;
  for (std::size_t i = 0; i < attribute->values.size(); i += attribute->components)
    vectors.push_back(Eigen::Map<const Eigen::Vector3d>(attribute->values.data() + i).cast<float>());
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

}  // namespace

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Embree(const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles) {
    // The shape of Embree's tree, and with it the choice between two triangles at a shared edge, depends on the
    // number of threads that build it.
    run_on_one_thread([&] { build(points, triangles); });
    if (!scene) throw Error(Fault::numerics, "the ray tracer could not be started");
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void build(const std::vector<Vector3f>& points, const std::vector<Triangle>& triangles) {
    device = rtcNewDevice(nullptr);
    if (!device) return;
    scene = rtcNewScene(device);
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
    rtcCommitScene(scene);
  }
};

RayScene::RayScene(const TriangleMesh& mesh, const std::vector<Vector3f>& points, const Eigen::Matrix3f& rotation)
    : points_(points),
      normals_(vertex_vectors(mesh, "normal")),
      colors_(vertex_vectors(mesh, "color")),
      triangles_(mesh.triangles) {
  for (Vector3f& normal : normals_) normal = rotation * normal;
  embree_ = std::make_unique<Embree>(points_, triangles_);
}

RayScene::~RayScene() = default;

std::optional<SurfacePoint> RayScene::intersect(const Vector3f& origin, const Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{make_ray(origin, direction), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return surface_point(direction, query.hit.primID, query.hit.u, query.hit.v);
}

bool RayScene::occluded(const Vector3f& origin, const Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0;
}

SurfacePoint RayScene::surface_point(const Vector3f& direction, std::uint32_t triangle, float u, float v) const {
  const Triangle& t = triangles_[triangle];
  const float w = 1 - u - v;
  const auto blend = [&](const std::vector<Vector3f>& values) -> Vector3f {
    return w * values[t[0]] + u * values[t[1]] + v * values[t[2]];
  };
  SurfacePoint point;
  point.position = blend(points_);
  point.color = colors_.empty() ? clay : blend(colors_);
  point.face_normal = (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized();
  if (point.face_normal.dot(direction) > 0) point.face_normal = -point.face_normal;
  point.normal = point.face_normal;
  point.lifted = point.position;
  const Vector3f smooth = normals_.empty() ? Vector3f::Zero().eval() : blend(normals_);
  if (smooth.squaredNorm() > 0.01F) {
    const float side = smooth.dot(point.face_normal) < 0 ? -1.0F : 1.0F;
    point.normal = side * smooth.normalized();
    // Hanika, "Hacking the Shadow Terminator" (Ray Tracing Gems II, 2021): start where the tangent planes of the
    // three corners meet above the flat triangle, lest each facet of a coarse mesh casts its own shadow.
    const float weight[] = {w, u, v};
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

// The limit surface against an independent program: OpenSubdiv's subdivision, limit masks and patches.

#include <gtest/gtest.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "base/box.h"
#include "discretise/loop_patch.h"
#include "discretise/sampling.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "run/program.h"
#include "shape/generators.h"
#include "shape/loop_subdivision.h"

namespace pelage {
namespace {

namespace osd = OpenSubdiv::OPENSUBDIV_VERSION;
using Vec = Eigen::Vector3d;

/// A value for OpenSubdiv's interpolation.
struct OsdVec {
  Vec value = Vec::Zero();
  void Clear() { value.setZero(); }
  void AddWithWeight(const OsdVec& other, double weight) { value += weight * other.value; }
};

using Refiner = std::unique_ptr<osd::Far::TopologyRefiner>;

Refiner make_refiner(const TriangleMesh& mesh) {
  const std::vector<int> corners(mesh.triangles.size(), 3);
  osd::Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.points.size());
  descriptor.numFaces = static_cast<int>(mesh.triangles.size());
  descriptor.numVertsPerFace = corners.data();
  descriptor.vertIndicesPerFace = mesh.triangles.data()->data();
  osd::Sdc::Options options;
  options.SetVtxBoundaryInterpolation(osd::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = osd::Far::TopologyRefinerFactory<osd::Far::TopologyDescriptor>;
  return Refiner(Factory::Create(descriptor, Factory::Options(osd::Sdc::SCHEME_LOOP, options)));
}

/// Largest deviations: of positions relative to the diagonal, of unit normals as vectors.
struct Deviation {
  double position = 0, normal = 0;

  void add_position(const Vec& a, const Vec& b, double diagonal) {
    position = std::max(position, (a - b).norm() / diagonal);
  }
  /// Only where both pairs of tangents span a plane.
  void add_normal(const Vec& a1, const Vec& a2, const Vec& b1, const Vec& b2) {
    const Vec a = a1.cross(a2), b = b1.cross(b2);
    constexpr double flat = 1e-2;  // sine of the angle between tangents below which round-off decides
    if (a.norm() < flat * a1.norm() * a2.norm() || b.norm() < flat * b1.norm() * b2.norm()) return;
    normal = std::max(normal, (a.normalized() - b.normalized()).norm());
  }
};

struct Frame {
  Vec position = Vec::Zero(), tangent1 = Vec::Zero(), tangent2 = Vec::Zero();
};

/// Our surface at a point of a face.
class Surface {
 public:
  explicit Surface(const TriangleMesh& mesh)
      : mesh_(mesh), topology_(make_topology(mesh.points.size(), mesh.triangles)) {}

  const Topology& topology() const { return topology_; }

  Frame at(Index face, double v, double w) {
    points_.clear();
    const Index patch_class = patches_.classify(topology_, face, points_);
    const PatchJet jet = patches_.evaluate(patch_class, v, w);
    Frame f;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec p(mesh_.points[static_cast<std::size_t>(points_[i])].data());
      const auto column = static_cast<Eigen::Index>(i);
      f.position += jet(0, column) * p;
      f.tangent1 += jet(1, column) * p;
      f.tangent2 += jet(2, column) * p;
    }
    return f;
  }

 private:
  const TriangleMesh& mesh_;
  Topology topology_;
  LoopPatches patches_;
  std::vector<Index> points_;
};

/// OpenSubdiv's limits at all vertices after one subdivision: those of the mesh and the middles of its edges.
struct OsdLimits {
  std::vector<OsdVec> position, tangent1, tangent2;
};

OsdLimits osd_limits(const osd::Far::TopologyRefiner& refiner, const TriangleMesh& mesh) {
  const osd::Far::PrimvarRefinerReal<double> interpolation(refiner);
  std::vector<OsdVec> control(mesh.points.size());
  for (std::size_t i = 0; i < control.size(); ++i) control[i].value = Vec(mesh.points[i].data());
  const auto count = static_cast<std::size_t>(refiner.GetLevel(1).GetNumVertices());
  std::vector<OsdVec> fine(count);
  interpolation.Interpolate(1, control, fine);
  OsdLimits limits{fine, fine, fine};
  interpolation.Limit(fine, limits.position, limits.tangent1, limits.tangent2);
  return limits;
}

/// The limit masks at the vertices. OpenSubdiv's tangents at boundary vertices with other than three triangles are
/// those of Hoppe's modified rules, not of the rules that it subdivides with: normals are not compared there.
void compare_vertices(const osd::Far::TopologyRefiner& refiner, const OsdLimits& limits, const TriangleMesh& mesh,
                      const Topology& topology, double diagonal, Deviation& worst) {
  const LimitMasks masks = loop_limit_masks(topology);
  const auto position = combine(masks.position, mesh.points), tangent1 = combine(masks.tangent1, mesh.points),
             tangent2 = combine(masks.tangent2, mesh.points);
  std::vector<Index> ring;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    const auto i = static_cast<std::size_t>(v);
    const auto theirs = static_cast<std::size_t>(refiner.GetLevel(0).GetVertexChildVertex(v));
    worst.add_position(Vec(position[i].data()), limits.position[theirs].value, diagonal);
    topology.one_ring(v, ring);
    if (topology.on_boundary(v) && ring.size() != 4) continue;
    worst.add_normal(Vec(tangent1[i].data()), Vec(tangent2[i].data()), limits.tangent1[theirs].value,
                     limits.tangent2[theirs].value);
  }
}

/// The patches at the middles of the edges, of every n-th face.
void compare_edges(const osd::Far::TopologyRefiner& refiner, const OsdLimits& limits, Surface& surface, Index every,
                   double diagonal, Deviation& worst) {
  const osd::Far::TopologyLevel& base = refiner.GetLevel(0);
  constexpr std::array<std::array<double, 2>, 3> middle = {{{0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
  for (Index face = 0; face < base.GetNumFaces(); face += every)
    for (int k = 0; k < 3; ++k) {
      const auto theirs = static_cast<std::size_t>(base.GetEdgeChildVertex(base.GetFaceEdges(face)[k]));
      const auto [v, w] = middle[static_cast<std::size_t>(k)];
      const Frame ours = surface.at(face, v, w);
      worst.add_position(ours.position, limits.position[theirs].value, diagonal);
      worst.add_normal(ours.tangent1, ours.tangent2, limits.tangent1[theirs].value, limits.tangent2[theirs].value);
    }
}

/// The patches inside of every n-th face. OpenSubdiv approximates within 2^-level of extraordinary vertices; the places
/// are further away.
void compare_inside(const osd::Far::TopologyRefiner& refiner, const TriangleMesh& mesh, Surface& surface, Index every,
                    double diagonal, Deviation& worst) {
  osd::Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(8).SetApproxLevelSharp(8);
  const osd::Bfr::RefinerSurfaceFactory<> factory(refiner, options);
  osd::Bfr::Surface<double> patch;
  std::vector<double> points;
  for (Index face = 0; face < static_cast<Index>(mesh.triangles.size()); face += every) {
    ASSERT_TRUE(factory.InitVertexSurface(face, &patch));
    points.resize(3 * static_cast<std::size_t>(patch.GetNumPatchPoints()));
    patch.PreparePatchPoints(mesh.points.data()->data(), 3, points.data(), 3);
    for (const std::array<double, 2>& uv : {std::array{1.0 / 3, 1.0 / 3}, {0.1, 0.17}, {0.23, 0.61}}) {
      Frame theirs;
      patch.Evaluate(uv.data(), points.data(), 3, theirs.position.data(), theirs.tangent1.data(),
                     theirs.tangent2.data());
      const Frame ours = surface.at(face, uv[0], uv[1]);
      worst.add_position(ours.position, theirs.position, diagonal);
      worst.add_normal(ours.tangent1, ours.tangent2, theirs.tangent1, theirs.tangent2);
    }
  }
}

constexpr Index sampled_faces = 300;  // whose insides are compared; OpenSubdiv takes about a millisecond for each

void compare(const std::string& name, const TriangleMesh& mesh) {
  SCOPED_TRACE(name);
  const Refiner refiner = make_refiner(mesh);
  ASSERT_TRUE(refiner);
  osd::Far::TopologyRefiner::UniformOptions once(1);
  once.fullTopologyInLastLevel = true;
  refiner->RefineUniform(once);
  const double diagonal = box_of(mesh.points).diagonal();
  Surface surface(mesh);
  const OsdLimits limits = osd_limits(*refiner, mesh);
  Deviation vertices, edges, inside;
  const auto faces = static_cast<Index>(mesh.triangles.size());
  compare_vertices(*refiner, limits, mesh, surface.topology(), diagonal, vertices);
  compare_edges(*refiner, limits, surface, std::max<Index>(1, faces / 5000), diagonal, edges);
  compare_inside(*refiner, mesh, surface, std::max<Index>(1, faces / sampled_faces), diagonal, inside);
  EXPECT_LT(vertices.position, 1e-12);
  EXPECT_LT(edges.position, 1e-12);
  EXPECT_LT(inside.position, 1e-12);
  EXPECT_LT(vertices.normal, 1e-9);
  EXPECT_LT(edges.normal, 1e-9);
  EXPECT_LT(inside.normal, 1e-9);
  char text[160];
  std::snprintf(text, sizeof text, "positions %.1e %.1e %.1e, normals %.1e %.1e %.1e", vertices.position,
                edges.position, inside.position, vertices.normal, edges.normal, inside.normal);
  ::testing::Test::RecordProperty(name, text);
}

/// A cone of `triangles` faces around vertex 0, wavy, with a second row of faces; closed around the vertex or a fan of
/// 300 degrees at a boundary.
TriangleMesh fan(int triangles, bool closed) {
  TriangleMesh mesh;
  mesh.points.push_back({0, 0, 0.4});
  const int ring = closed ? triangles : triangles + 1;
  for (int row = 1; row <= 2; ++row)
    for (int i = 0; i < ring; ++i) {
      const double angle = (closed ? 2 : 5.0 / 3) * std::numbers::pi * i / triangles;
      mesh.points.push_back({row * std::cos(angle), row * std::sin(angle), 0.2 * std::sin(3.0 * i + row)});
    }
  for (int i = 0; i < triangles; ++i) {
    const int a = 1 + i, b = 1 + (i + 1) % ring, c = a + ring, d = b + ring;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  return mesh;
}

TriangleMesh octahedron() {
  TriangleMesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 4; ++i) {
    mesh.triangles.push_back({i, (i + 1) % 4, 4});
    mesh.triangles.push_back({(i + 1) % 4, i, 5});
  }
  return mesh;
}

TEST(OpenSubdiv, SameSurfaceOnBuiltInShapes) {
  for (const char* name : {"sphere", "torus", "plane", "knot", "animal", "cube"})
    compare(name, builtin_shape(std::string("builtin:") + name + "?n=500"));
  compare("octahedron", octahedron());
}

TEST(OpenSubdiv, SameSurfaceAtEveryValence) {
  for (int n = 3; n <= 12; ++n) compare("valence_" + std::to_string(n), fan(n, true));
  for (int n = 1; n <= 8; ++n) compare("boundary_triangles_" + std::to_string(n), fan(n, false));
}

TEST(OpenSubdiv, SameSurfaceOnTheSharedMeshes) {
  const std::filesystem::path folder = PELAGE_SHARED_MESHES;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no folder of shared meshes";
  const std::vector<std::string> known = readable_extensions();
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::find(known.begin(), known.end(), entry.path().extension()) == known.end()) continue;
    TriangleMesh mesh;
    try {
      mesh = read_shape(entry.path().string()).mesh;
      make_topology(mesh.points.size(), mesh.triangles);
    } catch (const Error& e) {
      ::testing::Test::RecordProperty(entry.path().stem().string(), e.what());  // not manifold
      continue;
    }
    compare(entry.path().stem().string(), mesh);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

}  // namespace
}  // namespace pelage

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
#include <numeric>

#include "base/box.h"
#include "discretise/loop_patch.h"
#include "discretise/sampling.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "run/program.h"
#include "shape/creases.h"
#include "shape/generators.h"
#include "shape/hierarchy.h"
#include "shape/loop_subdivision.h"
#include "support/random_creases.h"

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

/// As OpenSubdiv takes them.
struct OsdCreases {
  std::vector<int> ends, corners;
  std::vector<float> edge_sharpness, corner_sharpness;

  explicit OsdCreases(const Topology& t) {
    if (!t.creases.any()) return;
    for (std::size_t h = 0; h < t.twin.size(); ++h)
      if (t.twin[h] > static_cast<Index>(h) && t.sharp(static_cast<Index>(h)))
        ends.insert(ends.end(), {t.origin(static_cast<Index>(h)), t.target(static_cast<Index>(h))});
    for (Index v = 0; v < t.vertex_count; ++v)
      if (t.creases.corner[static_cast<std::size_t>(v)]) corners.push_back(v);
    edge_sharpness.assign(ends.size() / 2, osd::Sdc::Crease::SHARPNESS_INFINITE);
    corner_sharpness.assign(corners.size(), osd::Sdc::Crease::SHARPNESS_INFINITE);
  }
};

Refiner make_refiner(const TriangleMesh& mesh, const Topology& topology) {
  const std::vector<int> corners(mesh.triangles.size(), 3);
  osd::Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.points.size());
  descriptor.numFaces = static_cast<int>(mesh.triangles.size());
  descriptor.numVertsPerFace = corners.data();
  descriptor.vertIndicesPerFace = mesh.triangles.data()->data();
  const OsdCreases creases(topology);
  descriptor.numCreases = static_cast<int>(creases.edge_sharpness.size());
  descriptor.creaseVertexIndexPairs = creases.ends.data();
  descriptor.creaseWeights = creases.edge_sharpness.data();
  descriptor.numCorners = static_cast<int>(creases.corners.size());
  descriptor.cornerVertexIndices = creases.corners.data();
  descriptor.cornerWeights = creases.corner_sharpness.data();
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
  Surface(const TriangleMesh& mesh, Topology topology) : mesh_(mesh), topology_(std::move(topology)) {}

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
  Surface surface(mesh, make_topology(mesh.points.size(), mesh.triangles));
  const Refiner refiner = make_refiner(mesh, surface.topology());
  ASSERT_TRUE(refiner);
  osd::Far::TopologyRefiner::UniformOptions once(1);
  once.fullTopologyInLastLevel = true;
  refiner->RefineUniform(once);
  const double diagonal = box_of(mesh.points).diagonal();
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

/// Our subdivided vertices against theirs, level after level: the same rules have the same limits.
double subdivision_deviation(const osd::Far::TopologyRefiner& refiner, const TriangleMesh& mesh, Topology topology,
                             int levels) {
  const osd::Far::PrimvarRefinerReal<double> interpolation(refiner);
  Hierarchy ours(std::move(topology), loop_refine);
  std::vector<OsdVec> theirs(mesh.points.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) theirs[i].value = Vec(mesh.points[i].data());
  std::vector<Point> points = mesh.points;
  std::vector<int> same(mesh.points.size());  // their number of our vertex
  std::iota(same.begin(), same.end(), 0);
  double worst = 0;
  for (int level = 0; level < levels; ++level) {
    const osd::Far::TopologyLevel& coarse = refiner.GetLevel(level);
    std::vector<OsdVec> fine(static_cast<std::size_t>(refiner.GetLevel(level + 1).GetNumVertices()));
    interpolation.Interpolate(level + 1, theirs, fine);
    theirs = std::move(fine);
    const Topology& t = ours.topology(level);
    std::vector<int> next(static_cast<std::size_t>(t.vertex_count) + static_cast<std::size_t>(t.edge_count));
    for (std::size_t v = 0; v < same.size(); ++v) next[v] = coarse.GetVertexChildVertex(same[v]);
    for (std::size_t h = 0; h < t.twin.size(); ++h) {
      const int a = same[static_cast<std::size_t>(t.origin(static_cast<Index>(h)))],
                b = same[static_cast<std::size_t>(t.target(static_cast<Index>(h)))];
      next[static_cast<std::size_t>(t.vertex_count + t.edge[h])] = coarse.GetEdgeChildVertex(coarse.FindEdge(a, b));
    }
    same = std::move(next);
    ours.refine();
    points = ours.refined(std::move(points), level, level + 1);
    for (std::size_t v = 0; v < same.size(); ++v)
      worst = std::max(worst, (Vec(points[v].data()) - theirs[static_cast<std::size_t>(same[v])].value).norm());
  }
  return worst / box_of(mesh.points).diagonal();
}

/// Their limits at the vertices of the mesh by the limit masks of that level.
std::vector<Vec> limits_at_level(const TriangleMesh& mesh, const Topology& topology, int levels) {
  const Refiner refiner = make_refiner(mesh, topology);
  osd::Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  const osd::Far::PrimvarRefinerReal<double> interpolation(*refiner);
  std::vector<OsdVec> values(mesh.points.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i].value = Vec(mesh.points[i].data());
  std::vector<int> same(mesh.points.size());
  std::iota(same.begin(), same.end(), 0);
  for (int level = 0; level < levels; ++level) {
    std::vector<OsdVec> fine(static_cast<std::size_t>(refiner->GetLevel(level + 1).GetNumVertices()));
    interpolation.Interpolate(level + 1, values, fine);
    values = std::move(fine);
    for (int& v : same) v = refiner->GetLevel(level).GetVertexChildVertex(v);
  }
  std::vector<OsdVec> limit(values.size());
  interpolation.Limit(values, limit);
  std::vector<Vec> result;
  for (const int v : same) result.push_back(limit[static_cast<std::size_t>(v)].value);
  return result;
}

/// At the ends of creases their masks are those of smooth vertices, which is wrong by as much as the level is coarse:
/// of three levels the limit is extrapolated.
double limit_deviation(const TriangleMesh& mesh, const Topology& topology, bool ends) {
  const std::vector<Point> ours = loop_limits(topology, mesh.points);
  std::vector<std::vector<Vec>> theirs;
  for (const int level : ends ? std::vector{4, 5, 6} : std::vector{1})
    theirs.push_back(limits_at_level(mesh, topology, level));
  VertexRing around;
  double worst = 0;
  for (std::size_t v = 0; v < ours.size(); ++v) {
    vertex_ring(topology, static_cast<Index>(v), around);
    const bool end = around.sharp.size() == 1;
    if (end && !ends) continue;
    Vec limit = theirs.back()[v];
    if (end) {
      const Vec before = theirs[1][v] - theirs[0][v], last = theirs[2][v] - theirs[1][v];
      const double ratio = last.norm() / before.norm();
      limit += ratio / (1 - ratio) * last;
    }
    worst = std::max(worst, (Vec(ours[v].data()) - limit).norm());
  }
  return worst / box_of(mesh.points).diagonal();
}

/// The normals of corners on creases against those of our own patches, which compare_inside checks, near them. Where
/// three triangles lie between two sharp edges the patches are polynomials; elsewhere they come nearer and nearer, the
/// slower the more triangles there are.
struct CornerDeviation {
  double regular = 0, other = 0;
};

CornerDeviation corner_normal_deviation(const TriangleMesh& mesh, Surface& surface) {
  const Topology& t = surface.topology();
  const CornerNormals normals(t, mesh.points);
  const CutMesh cut = cut_at_creases(t);
  std::vector<int> triangles(cut.vertex.size(), 0);
  for (const Triangle& c : cut.triangles)
    for (const Index v : c) ++triangles[static_cast<std::size_t>(v)];
  VertexRing around;
  CornerDeviation worst;
  for (std::size_t f = 0; f < t.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      vertex_ring(t, t.triangles[f][k], around);
      const int count = triangles[static_cast<std::size_t>(cut.triangles[f][k])];
      // With six, surfaces on boundaries and creases have no tangent plane; in one, both sides are the same line.
      const bool defined = around.sharp.size() == 1 || (count > 1 && count < 5);
      if (around.sharp.empty() || around.corner || !defined) continue;
      constexpr double e = 1e-8;
      constexpr std::array<std::array<double, 2>, 3> near = {{{e, e}, {1 - 2 * e, e}, {e, 1 - 2 * e}}};
      const Frame patch = surface.at(static_cast<Index>(f), near[k][0], near[k][1]);
      const Vec n = patch.tangent1.cross(patch.tangent2).normalized();
      double& kind = around.sharp.size() > 1 && count == 3 ? worst.regular : worst.other;
      kind = std::max(kind, (n - Vec(normals.at(f, k).data())).norm());
    }
  return worst;
}

void compare_creased(const std::string& name, const TriangleMesh& mesh, const Creases& creases, bool ends = false) {
  SCOPED_TRACE(name);
  Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  topology.creases = creases;
  ASSERT_TRUE(creases.any());
  const Refiner refiner = make_refiner(mesh, topology);
  ASSERT_TRUE(refiner);
  Surface surface(mesh, topology);
  osd::Far::TopologyRefiner::UniformOptions twice(2);
  twice.fullTopologyInLastLevel = true;
  refiner->RefineUniform(twice);
  const double subdivided = subdivision_deviation(*refiner, mesh, topology, 2);
  const double limits = limit_deviation(mesh, topology, ends);
  Deviation inside;
  const auto faces = static_cast<Index>(mesh.triangles.size());
  compare_inside(*refiner, mesh, surface, std::max<Index>(1, faces / sampled_faces), box_of(mesh.points).diagonal(),
                 inside);
  const CornerDeviation corners = corner_normal_deviation(mesh, surface);
  EXPECT_LT(subdivided, 1e-12);
  EXPECT_LT(limits, 1e-5);
  EXPECT_LT(inside.position, 1e-5);
  EXPECT_LT(inside.normal, 1e-5);
  EXPECT_LT(corners.regular, 1e-5);
  EXPECT_LT(corners.other, 0.1);
  char text[160];
  std::snprintf(text, sizeof text, "subdivided %.1e, limits %.1e, inside %.1e, normals %.1e, at corners %.1e %.1e",
                subdivided, limits, inside.position, inside.normal, corners.regular, corners.other);
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

/// The edges of a fan from its middle to these vertices of its ring.
Creases spokes(const TriangleMesh& mesh, const std::vector<Index>& to) {
  const Topology t = make_topology(mesh.points.size(), mesh.triangles);
  Creases creases{std::vector<char>(static_cast<std::size_t>(t.edge_count)), std::vector<char>(mesh.points.size())};
  for (std::size_t h = 0; h < t.twin.size(); ++h)
    if (t.origin(static_cast<Index>(h)) == 0 &&
        std::find(to.begin(), to.end(), t.target(static_cast<Index>(h))) != to.end())
      creases.edge[static_cast<std::size_t>(t.edge[h])] = true;
  creases.corner[0] = to.size() > 2;
  return creases;
}

TEST(OpenSubdiv, SameCreasesOnBuiltInShapes) {
  for (const char* name : {"sphere", "torus", "animal", "cube", "plane"}) {
    const TriangleMesh mesh = builtin_shape(std::string("builtin:") + name + "?n=150");
    const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
    compare_creased(name, mesh, pelage::testing::random_creases(topology, 0.15));
  }
  const TriangleMesh cube = builtin_shape("builtin:cube?n=500");
  compare_creased("edges of a cube", cube,
                  creases_above(40, make_topology(cube.points.size(), cube.triangles), cube.points));
}

/// Ends, lines and corners of creases among as many triangles as there may be.
TEST(OpenSubdiv, SameCreasesAtEveryValence) {
  for (int n = 3; n <= 10; ++n) {
    const TriangleMesh mesh = fan(n, true);
    const std::string of = " of " + std::to_string(n);
    compare_creased("end" + of, mesh, spokes(mesh, {2}), true);
    for (int k = 1; k <= n / 2; ++k) compare_creased("line" + of, mesh, spokes(mesh, {1, 1 + k}));
    compare_creased("corner" + of, mesh, spokes(mesh, {1, 2, n}));
  }
}

TEST(OpenSubdiv, SameCreasesOnAMachinePart) {
  const std::filesystem::path path = std::filesystem::path(PELAGE_SHARED_MESHES) / "fandisk_6475.off";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no folder of shared meshes";
  const TriangleMesh mesh = read_shape(path.string()).mesh;
  compare_creased("fandisk", mesh, creases_above(40, make_topology(mesh.points.size(), mesh.triangles), mesh.points));
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

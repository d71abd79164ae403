#pragma once
// The nodes of a glTF file: what is shown, and where.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "pelage/point.h"
#include "shape/finding.h"

namespace pelage {

/// Column-major 4x4, as in glTF.
using GltfMatrix = std::array<double, 16>;
constexpr GltfMatrix gltf_identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

GltfMatrix operator*(const GltfMatrix& a, const GltfMatrix& b);
Point transformed(const GltfMatrix& m, const Point& p);
/// A vector along the surface.
Point turned(const GltfMatrix& m, const Point& vector);
/// The unit normal of the surface that the matrix makes of one with this normal; 0 where it makes it flat.
Point turned_normal(const GltfMatrix& m, const Point& normal);
/// Negative where the matrix turns a surface inside out.
double determinant3(const GltfMatrix& m);
/// translation * rotation * scale; the rotation is a quaternion x, y, z, w.
GltfMatrix compose(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                   const std::array<double, 3>& scale);

class GltfScene {
 public:
  /// Error(Fault::input) unless the nodes form trees.
  explicit GltfScene(const GltfDocument& document);

  /// The nodes with a mesh (or a "camera") in the order in which viewers pass through them: those of the default scene,
  /// without scenes all. Hidden ones (KHR_node_visibility) are left out. Appends what is not shown.
  std::vector<std::size_t> shown(std::vector<Finding>& findings, const char* what = "mesh") const;
  const GltfMatrix& world(std::size_t node) const { return world_[node]; }

 private:
  GltfMatrix local(std::size_t node) const;
  void place_nodes();
  std::vector<std::size_t> roots(std::vector<Finding>& findings) const;

  const GltfDocument& document_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<char> is_child_;
  std::vector<GltfMatrix> world_;
};

/// How the joints of a node's skin move points in the rest pose. The transform of the node itself does not count.
class GltfSkin {
 public:
  GltfSkin(GltfDocument& document, const GltfScene& scene, std::size_t skin);

  /// One of the joints: from the mesh to the world.
  const GltfMatrix& joint(std::size_t j) const { return joints_[j]; }
  std::size_t size() const { return joints_.size(); }

 private:
  std::vector<GltfMatrix> joints_;
};

}  // namespace pelage

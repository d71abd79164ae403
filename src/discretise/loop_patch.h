#pragma once
// The limit surface of Loop subdivision over one triangle, for corners of any valence, inside, on the boundary or on
// creases.
//
// A triangle's patch depends on the control points of its corners and their neighbours only. Triangles whose corners
// have the same valences share one PatchClass: the connectivity of those control points, and the matrices that take
// them to the control points of the four children after one subdivision step. A point is evaluated by descending into
// children until the patch is a polynomial (a box spline, with reflected points outside a boundary); an extraordinary
// corner itself is the limit of the descent and only reached by the limit masks.
//
// A crease is a boundary for the triangles on each of its sides: of a corner on it only the neighbours between two
// sharp edges count. Only where a corner of the triangle is the end of a crease, which has no sides, all rings are
// whole.

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "shape/topology.h"

namespace pelage {

/// Neighbourhood of one corner of a triangle.
struct CornerType {
  Index valence = 6;    ///< number of edges at the corner
  Index position = -1;  ///< -1 inside; on the boundary the rank of the triangle in the corner's fan, counter-clockwise
  bool fixed = false;   ///< a corner of creases, which stays where it is
  std::vector<Index> creases = {};  ///< in whole rings: the ranks of the neighbours to which creases lead
  auto operator<=>(const CornerType&) const = default;  // NOLINT: taken for a null pointer
};
using PatchSignature = std::array<CornerType, 3>;

/// A corner with its neighbours. Inside: counter-clockwise, the triangle's next corner (rank 0) and the one after (rank
/// 1) first. On the boundary: from the first to the last; the triangle's corners have ranks `position`, position + 1.
struct PatchCorner {
  CornerType type;
  std::vector<Index> ring;
};

/// Rows: value, d/dv, d/dw, d2/dv2, d2/dvdw, d2/dw2 of the basis functions (columns) at a point (1-v-w) a + v b + w c.
using PatchJet = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

class LoopPatches {
 public:
  /// The class of triangle `face`, made when it is new, and the control points of the triangle in the class's order
  /// (appended to `points`): the corners first, then the outer points counter-clockwise.
  Index classify(const Topology& topology, Index face, std::vector<Index>& points);

  std::size_t class_count() const { return classes_.size(); }
  /// Number of control points.
  Index size(Index patch_class) const { return classes_[static_cast<std::size_t>(patch_class)].size; }
  /// Whether the patch is one polynomial.
  bool polynomial(Index patch_class) const;

  /// Basis functions at (v, w), v, w >= 0, v + w <= 1. At an extraordinary corner the first derivatives are those of a
  /// point 2^-40 away (they tend to zero or infinity there; directions are right).
  PatchJet evaluate(Index patch_class, double v, double w) const;

 private:
  struct Source {
    std::size_t corner;
    std::size_t rank;  ///< in the corner's ring
  };
  struct PatchClass {
    PatchSignature signature;
    Index size = 0;
    std::vector<Source> sources;  ///< of control points 3, 4, ...
    std::vector<Triangle>
        triangles;  ///< all triangles that touch a corner, in local numbers; the patch itself is first
    std::vector<std::array<Index, 2>> creases;  ///< sharp edges from a corner, but those of the boundary
    Eigen::MatrixXd expansion;  ///< 12 x size: box spline points; empty when the patch is not a polynomial
    std::array<Index, 4> child{-1, -1, -1, -1};
    std::array<Eigen::MatrixXd, 4> child_points;  ///< size(child) x size
  };

  using RingNumbers = std::array<std::vector<Index>, 3>;

  static void number_points(PatchClass& patch, RingNumbers& id);
  static void list_triangles(PatchClass& patch, const RingNumbers& id);
  static void list_creases(PatchClass& patch, const RingNumbers& id);
  static void expand_to_box_spline(PatchClass& patch, const RingNumbers& id);
  static Topology topology_of(const PatchClass& patch);
  static PatchClass make_class(const PatchSignature& signature);
  void make_class_and_children(const PatchSignature& signature);
  void make_children(Index patch_class);

  std::vector<PatchClass> classes_;
  std::map<PatchSignature, Index> by_signature_;
  std::array<PatchCorner, 3> scratch_;
};

}  // namespace pelage

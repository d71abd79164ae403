#pragma once
// A mesh of our own on the limit surface of the user's: even triangles of the edge that the pattern needs, whatever the
// user's are like. Its vertices know where on the shape they lie; fields go back by evaluation.

#include <memory>
#include <vector>

#include "shape/creases.h"
#include "shape/hierarchy.h"
#include "shape/isotropic_mesh.h"

namespace pelage {

/// At (1-v-w) a + v b + w c of a triangle whose surface has these unit normals at its corners (cubic_triangle.h).
Point smooth_point(const std::array<Point, 3>& corners, const std::array<Point, 3>& normals, double v, double w);

class SimulationMesh {
 public:
  struct Edge {
    double smallest;
    std::vector<double> at_vertices;  ///< of the shape; empty: the same everywhere
  };
  /// On the limit surface of the control points `control` at the finest of the levels, which is level 0. Adds levels,
  /// and refines the points with them, until their triangles are about as large as its own. Error(Fault::input) when
  /// it would have more than `max_triangles`; Error(Fault::cancelled).
  SimulationMesh(Hierarchy& levels, std::vector<Point>& control, const Edge& edge, std::size_t max_triangles,
                 const Progress& progress = {});

  const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }
  std::size_t vertices() const { return places_.size(); }

  /// Where the vertices are when the control points at the finest level are these.
  std::vector<Point> points(const std::vector<Point>& control) const;

  /// What is given at the vertices of the shape, tuple after tuple, or at its corners: linear over its triangles.
  std::vector<double> values(const std::vector<double>& at_vertices, std::size_t components) const;
  Attribute values(const Attribute& given) const;

 private:
  std::shared_ptr<const Topology> topology_, base_, finest_;
  std::vector<MeshPlace> places_;  ///< on the finest level
  int levels_;                     ///< between that and the shape
};

/// Fields that are given at the vertices of a mesh, anywhere on it: smooth along its edges, and at its vertices with
/// the mean gradient of the triangles there.
class MeshFields {
 public:
  /// Keeps references to points and fields.
  MeshFields(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
             const std::vector<std::vector<double>>& fields);
  /// On creases with the gradients of each side.
  MeshFields(const Topology& mesh, const std::vector<Point>& points, const std::vector<std::vector<double>>& fields);
  /// On a face. Thread-safe.
  double at(std::size_t field, const MeshPlace& place) const;

 private:
  MeshFields(CutMesh cut, const std::vector<Point>& points, const std::vector<std::vector<double>>& fields);

  CutMesh mesh_;
  const std::vector<Point>& points_;
  const std::vector<std::vector<double>>& fields_;
  std::vector<std::vector<Point>> gradients_;  ///< at the vertices of the cut mesh
};

/// The same at many places; 0 at those that are on no face.
std::vector<std::vector<double>> fields_at(const std::vector<MeshPlace>& places, const Topology& mesh,
                                           const std::vector<Point>& points,
                                           const std::vector<std::vector<double>>& fields);

}  // namespace pelage

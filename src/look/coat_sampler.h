#pragma once
// A coat at any place of the mesh that it has grown on.

#include <memory>
#include <span>

#include "look/tessellation.h"

namespace pelage {

class SurfaceWalk;
class MeshFields;
class OntoMesh;

class CoatSampler {
 public:
  /// `tessellation`: of these fields, on the surface that they have grown on. Of the fields only those that the paint
  /// reads are sampled. `onto`: a mesh that shows it instead of the shape, or null. Keeps references to all.
  CoatSampler(const CoatFields& fields, const Tessellation& tessellation, const Paint& paint,
              const OntoMesh* onto = nullptr);
  ~CoatSampler();

  /// The triangles that the tessellation was split from: those of the shape, on which places are counted where no other
  /// mesh shows the coat.
  const std::vector<Triangle>& triangles() const;
  bool onto_other() const { return onto_ != nullptr; }
  const Tessellation& tessellation() const { return t_; }
  /// The place on it; beyond a triangle its plane goes on, to the place that `walk`, on the tessellation, finds
  /// nearest.
  MeshPlace on_tessellation(const MeshPlace& place, const SurfaceWalk& walk) const;
  /// On the surface, at these places of the shape's triangles or those of the mesh that shows it. Fields are what they
  /// are on their own mesh, there where the surface lies; beyond a triangle its plane goes on, to the place of the
  /// fields' mesh that is nearest, or, where they have none, only to the border. Thread-safe.
  CoatSamples samples(std::span<const MeshPlace> places) const;

 private:
  /// A place on the tessellation, and how far the one that was asked for lies beyond it.
  struct Spot {
    std::size_t face;
    double v, w, beyond_v, beyond_w;
  };
  /// `near`: a triangle of the tessellation that is likely near, or -1.
  Spot spot_of(MeshPlace place, Index near = -1) const;
  Point position(const Spot& spot) const;
  Point normal(const Spot& spot) const;
  /// As the plane of its triangle goes on.
  Point moved_beyond(Point p, const Spot& spot) const;
  MeshPlace field_place(const Spot& spot, const Point& position, Index near) const;
  Index near_face(const Spot& spot) const;
  double field(std::size_t i, const MeshPlace& place) const;

  const CoatFields& fields_;
  const Tessellation& t_;
  const OntoMesh* onto_;
  CoatSamples shared_;  ///< what all samples have in common
  std::vector<char> needed_;
  int levels_ = 0;  ///< how often the triangles of the shape are split
  bool smooth_;
  std::unique_ptr<const SurfaceWalk> walk_;  ///< on the mesh of the fields
  std::unique_ptr<const MeshFields> anywhere_;
};

}  // namespace pelage
